#include "ground/capture/view_server.hpp"

#include <microhttpd.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <chrono>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "fsw/kernel/input_error.hpp"
#include "ground/capture/view_page.hpp"
#include "ground/capture/view_picture.hpp"

namespace omma::ground {
namespace {

using std::chrono::milliseconds;

constexpr int kQuality = 85;
constexpr unsigned kMostReaders = 32;
constexpr unsigned kIdleSeconds = 30;       // after which a connection that asks nothing is closed
constexpr milliseconds kFrameWait{500};     // at a time, so that the end of the program is heard
constexpr int kWaitsForFrame = 20;          // then a stream ends; the page asks again
constexpr milliseconds kLeastInterval{40};  // of a stream: no eye sees more
constexpr const char* kBoundary = "omma-frame";
constexpr std::size_t kBlockBytes = 64U << 10U;

/// How a reader wants to see a camera.
struct Look {
  int width = 16384;
  bool stretch = true;
};

std::vector<std::byte> jpeg_of(const ShownFrame& frame, const Look& look) {
  const ImageView image = frame.image.view();
  // Whole cells: of unequal ones the larger would be brighter, a pattern over the noise.
  const int cell = (image.width + look.width - 1) / look.width;
  const int width = std::max(1, image.width / cell);
  const int height = std::max(1, image.height / cell);
  return encode_jpeg(view_picture(image, width, height, look.stretch).view(), kQuality);
}

/// The frames of one camera on their way to one reader.
class Stream {
 public:
  Stream(Recorder& recorder, const Look& look, const std::atomic<bool>& ends)
      : recorder_(recorder), look_(look), ends_(ends) {}

  ssize_t read(char* into, std::size_t most) {
    if (sent_ == part_.size() && !next()) return MHD_CONTENT_READER_END_OF_STREAM;
    const std::size_t count = std::min(most, part_.size() - sent_);
    std::memcpy(into, part_.data() + sent_, count);
    sent_ += count;
    return static_cast<ssize_t>(count);
  }

 private:
  bool next() {
    std::this_thread::sleep_until(last_ + kLeastInterval);
    for (int i = 0; i < kWaitsForFrame && !ends_.load(); ++i) {
      const auto frame = recorder_.shown().newer(count_, kFrameWait);
      if (!frame) continue;
      last_ = std::chrono::steady_clock::now();
      count_ = frame->count;
      const std::vector<std::byte> jpeg = jpeg_of(*frame, look_);
      part_ = std::string("--") + kBoundary +
              "\r\nContent-Type: image/jpeg\r\nContent-Length: " + std::to_string(jpeg.size()) + "\r\n\r\n";
      part_.append(reinterpret_cast<const char*>(jpeg.data()), jpeg.size());
      part_ += "\r\n";
      sent_ = 0;
      return true;
    }
    return false;
  }

  Recorder& recorder_;
  Look look_;
  const std::atomic<bool>& ends_;
  std::uint64_t count_ = 0;
  std::chrono::steady_clock::time_point last_{};
  std::string part_;
  std::size_t sent_ = 0;
};

MHD_Result answer(MHD_Connection* connection, unsigned code, const char* type, MHD_Response* response) {
  if (response == nullptr) return MHD_NO;
  MHD_add_response_header(response, MHD_HTTP_HEADER_CONTENT_TYPE, type);
  MHD_add_response_header(response, MHD_HTTP_HEADER_CACHE_CONTROL, "no-store");
  const MHD_Result queued = MHD_queue_response(connection, code, response);
  MHD_destroy_response(response);
  return queued;
}

MHD_Result answer(MHD_Connection* connection, unsigned code, const char* type, std::string_view body) {
  return answer(
      connection, code, type,
      MHD_create_response_from_buffer(body.size(), const_cast<char*>(body.data()), MHD_RESPMEM_MUST_COPY));
}

MHD_Result say(MHD_Connection* connection, unsigned code, const std::string& sentence) {
  return answer(connection, code, "text/plain; charset=utf-8", sentence + "\n");
}

/// None where the words of the request are not understood.
std::optional<Look> look_of(MHD_Connection* connection) {
  Look look;
  if (const char* const width = MHD_lookup_connection_value(connection, MHD_GET_ARGUMENT_KIND, "width")) {
    const char* const end = width + std::strlen(width);
    const auto [stop, error] = std::from_chars(width, end, look.width);
    if (error != std::errc{} || stop != end || look.width < 16) return std::nullopt;
  }
  if (const char* const stretch = MHD_lookup_connection_value(connection, MHD_GET_ARGUMENT_KIND, "stretch"))
    look.stretch = std::string_view(stretch) != "0";
  return look;
}

bool take_end(std::string_view& text, std::string_view end) {
  if (!text.ends_with(end)) return false;
  text.remove_suffix(end.size());
  return true;
}

}  // namespace

struct ViewServer::Daemon {
  Daemon(Recorders& all, ViewAddress where) : recorders(all), address(std::move(where)) {}

  static MHD_Result respond(void* self, MHD_Connection* connection, const char* url, const char* method,
                            const char* /*version*/, const char* /*data*/, std::size_t* /*size*/,
                            void** /*of_request*/) {
    auto& daemon = *static_cast<Daemon*>(self);
    if (std::string_view(method) != MHD_HTTP_METHOD_GET && std::string_view(method) != MHD_HTTP_METHOD_HEAD)
      return say(connection, MHD_HTTP_METHOD_NOT_ALLOWED, "expected GET, found " + std::string(method));
    const std::string_view path = url;
    if (path == "/") return answer(connection, MHD_HTTP_OK, "text/html; charset=utf-8", view_page());
    if (path == "/status.json")
      return answer(connection, MHD_HTTP_OK, "application/json", view_status(daemon.recorders));
    constexpr std::string_view kCamera = "/camera/";
    if (path.starts_with(kCamera)) return daemon.camera(connection, path.substr(kCamera.size()));
    return say(connection, MHD_HTTP_NOT_FOUND,
               "expected /, /status.json or /camera/NAME.jpg or .mjpg, found " + std::string(path));
  }

  MHD_Result camera(MHD_Connection* connection, std::string_view name) {
    const bool stream = take_end(name, ".mjpg");
    const bool one = !stream && take_end(name, ".jpg");
    const auto found = std::find_if(recorders.begin(), recorders.end(),
                                    [&](const Recorder& recorder) { return recorder.name() == name; });
    if (found == recorders.end() || (!stream && !one))
      return say(connection, MHD_HTTP_NOT_FOUND,
                 "expected a camera of /status.json with .jpg or .mjpg, found " + std::string(name));
    const std::optional<Look> look = look_of(connection);
    if (!look) return say(connection, MHD_HTTP_BAD_REQUEST, "width: expected a number from 16");
    if (stream) return frames(connection, *found, *look);
    const auto newest = found->shown().newest();
    const auto frame = found->shown().newer(newest ? newest->count : 0, milliseconds(2000));
    if (!frame) return say(connection, MHD_HTTP_SERVICE_UNAVAILABLE, "no frame came within two seconds");
    const std::vector<std::byte> jpeg = jpeg_of(*frame, *look);
    return answer(connection, MHD_HTTP_OK, "image/jpeg",
                  std::string_view(reinterpret_cast<const char*>(jpeg.data()), jpeg.size()));
  }

  MHD_Result frames(MHD_Connection* connection, Recorder& recorder, const Look& look) {
    const auto read = [](void* stream, std::uint64_t, char* into, std::size_t most) {
      return static_cast<Stream*>(stream)->read(into, most);
    };
    const auto release = [](void* stream) { delete static_cast<Stream*>(stream); };
    const std::string type = std::string("multipart/x-mixed-replace; boundary=") + kBoundary;
    return answer(connection, MHD_HTTP_OK, type.c_str(),
                  MHD_create_response_from_callback(MHD_SIZE_UNKNOWN, kBlockBytes, read,
                                                    new Stream(recorder, look, ends), release));
  }

  Recorders& recorders;
  ViewAddress address;
  std::atomic<bool> ends{false};
  MHD_Daemon* server = nullptr;
};

ViewServer::ViewServer(Recorders& recorders, ViewAddress address)
    : daemon_(std::make_unique<Daemon>(recorders, std::move(address))) {
  const int listening = listen_at(daemon_->address);
  daemon_->server = MHD_start_daemon(
      MHD_USE_THREAD_PER_CONNECTION | MHD_USE_INTERNAL_POLLING_THREAD, 0, nullptr, nullptr, Daemon::respond,
      daemon_.get(), MHD_OPTION_LISTEN_SOCKET, listening, MHD_OPTION_CONNECTION_LIMIT, kMostReaders,
      MHD_OPTION_CONNECTION_TIMEOUT, kIdleSeconds, MHD_OPTION_END);
  if (daemon_->server == nullptr) {
    ::close(listening);
    throw InputError("omma capture", 0, "--serve", "a server at " + url_of(daemon_->address), "none");
  }
}

ViewServer::~ViewServer() {
  daemon_->ends.store(true);
  MHD_stop_daemon(daemon_->server);
}

const ViewAddress& ViewServer::address() const {
  return daemon_->address;
}

std::string view_status(Recorders& recorders) {
  nlohmann::ordered_json cameras = nlohmann::ordered_json::array();
  for (const Recorder& recorder : recorders) {
    const CameraHealth health = recorder.health();
    cameras.push_back({{"name", recorder.name()},
                       {"driver", recorder.driver()},
                       {"width", recorder.shape().width},
                       {"height", recorder.shape().height},
                       {"white_level", recorder.shape().white_level},
                       {"connected", health.connected},
                       {"frames", recorder.taken()},
                       {"rate_hz", recorder.newest_rate_hz()},
                       {"exposure_ms", static_cast<double>(recorder.exposure_ns()) * 1e-6},
                       {"gain", recorder.gain()},
                       {"written_mb", static_cast<double>(recorder.bytes()) * 1e-6},
                       {"lost",
                        {{"gaps", health.gaps},
                         {"damaged", health.damaged},
                         {"without_room", health.overrun},
                         {"times_gone", health.losses}}}});
  }
  return nlohmann::ordered_json{{"cameras", cameras}}.dump(1);
}

}  // namespace omma::ground
