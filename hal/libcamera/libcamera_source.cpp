#include "hal/libcamera/libcamera_source.hpp"

#include <libcamera/libcamera.h>
#include <sys/mman.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <condition_variable>
#include <iterator>
#include <mutex>
#include <stdexcept>
#include <utility>

#include "fsw/kernel/input_error.hpp"
#include "hal/libcamera/libcamera_names.hpp"
#include "hal/libcamera/streaming_nodes.hpp"

namespace omma {
namespace {

/// libcamera's one manager of the program, which looks for cameras once: some of its pipelines (vimc's,
/// IPU3's) lay the links of their devices anew whenever they are looked for, which fails beside a stream.
libcamera::CameraManager& manager() {
  static std::mutex mutex;
  static std::unique_ptr<libcamera::CameraManager> running;
  const std::lock_guard<std::mutex> lock(mutex);
  if (running) return *running;
  auto made = std::make_unique<libcamera::CameraManager>();
  if (made->start() != 0) throw std::runtime_error("libcamera cannot look for cameras");
  running = std::move(made);
  return *running;
}

std::string model_of(const libcamera::Camera& camera) {
  return camera.properties().get(libcamera::properties::Model).value_or("");
}

std::string size_text(const libcamera::Size& size) {
  return std::to_string(size.width) + " x " + std::to_string(size.height);
}

}  // namespace

struct LibcameraSource::Stream {
  std::shared_ptr<libcamera::Camera> camera;
  std::unique_ptr<libcamera::CameraConfiguration> configuration;
  std::unique_ptr<libcamera::FrameBufferAllocator> allocator;
  std::vector<std::unique_ptr<libcamera::Request>> requests;
  struct Mapping {
    const libcamera::FrameBuffer* buffer = nullptr;
    void* memory = nullptr;
    std::size_t size = 0;
    std::size_t offset = 0;
  };
  std::vector<Mapping> mappings;
  bool acquired = false;
  bool started = false;
  bool connected = false;
  std::vector<int> nodes;  // of the kernel that it streams from

  // Finished requests, from libcamera's thread to the camera's.
  std::mutex mutex;
  std::condition_variable arrived;
  std::array<libcamera::Request*, 32> finished{};
  std::size_t finished_count = 0;

  void on_request(libcamera::Request* request) {
    if (request->status() == libcamera::Request::RequestCancelled) return;
    {
      const std::lock_guard<std::mutex> lock(mutex);
      if (finished_count < finished.size()) finished[finished_count++] = request;
    }
    arrived.notify_one();
  }
  void open(const CameraSetup& setup, const PixelLayout& layout, const GreyShape& shape);
  void configure(const CameraSetup& setup, const PixelLayout& layout, const GreyShape& shape);
  void map(const CameraSetup& setup);
  libcamera::Request* wait(int timeout_ms);
  const Mapping* mapping_of(const libcamera::FrameBuffer* buffer) const {
    const auto at =
        std::find_if(mappings.begin(), mappings.end(), [&](const Mapping& m) { return m.buffer == buffer; });
    return at == mappings.end() ? nullptr : &*at;
  }
  ~Stream();
};

void LibcameraSource::Stream::open(const CameraSetup& setup, const PixelLayout& layout,
                                   const GreyShape& shape) {
  const auto all = manager().cameras();
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& one) {
    return one->id() == setup.device || model_of(*one) == setup.device;
  });
  if (found == all.end()) throw InputError(setup.where, 0, "device", "a camera of libcamera's", setup.device);
  camera = *found;
  if (camera->acquire() != 0)
    throw InputError(setup.where, 0, "device", "a camera nobody uses", setup.device + ", which is in use");
  acquired = true;
  configure(setup, layout, shape);
  map(setup);
  camera->requestCompleted.connect(this, &Stream::on_request);
  connected = true;
  libcamera::ControlList controls(camera->controls());
  read_libcamera_controls(setup, camera->controls(), controls);
  const std::vector<int> before = streaming_nodes();
  if (camera->start(&controls) != 0)
    throw InputError(setup.where, 0, "device", "a stream from " + setup.device, "none");
  started = true;
  const std::vector<int> after = streaming_nodes();
  std::set_difference(after.begin(), after.end(), before.begin(), before.end(), std::back_inserter(nodes));
  for (const auto& request : requests) camera->queueRequest(request.get());
}

void LibcameraSource::Stream::configure(const CameraSetup& setup, const PixelLayout& layout,
                                        const GreyShape& shape) {
  configuration = camera->generateConfiguration(
      {is_raw(layout) ? libcamera::StreamRole::Raw : libcamera::StreamRole::Viewfinder});
  if (!configuration || configuration->empty()) {
    throw InputError(setup.where, 0, "format", "one of a stream that the camera has",
                     setup.format + (is_raw(layout) ? ", of a raw stream" : ", of a processed stream"));
  }
  libcamera::StreamConfiguration& stream = configuration->at(0);
  const int cell = binning(layout, setup.bayer);
  const libcamera::Size size(static_cast<unsigned>(cell * shape.width),
                             static_cast<unsigned>(cell * shape.height));
  stream.pixelFormat = libcamera_format(layout);
  stream.size = size;
  stream.bufferCount = static_cast<unsigned>(setup.buffers);
  if (configuration->validate() == libcamera::CameraConfiguration::Invalid || stream.size != size ||
      stream.pixelFormat != libcamera_format(layout)) {
    throw InputError(setup.where, 0, "format",
                     setup.format + " of " + size_text(size) + " px from " + setup.device,
                     format_name(stream.pixelFormat) + " of " + size_text(stream.size) + " px");
  }
  if (camera->configure(configuration.get()) != 0)
    throw InputError(setup.where, 0, "format", "one that " + setup.device + " takes", setup.format);
}

void LibcameraSource::Stream::map(const CameraSetup& setup) {
  libcamera::Stream* const stream = configuration->at(0).stream();
  allocator = std::make_unique<libcamera::FrameBufferAllocator>(camera);
  if (allocator->allocate(stream) < 0)
    throw InputError(setup.where, 0, "buffers", "memory for frames", "none");
  for (const auto& buffer : allocator->buffers(stream)) {
    const libcamera::FrameBuffer::Plane& plane = buffer->planes()[0];
    const std::size_t size = plane.offset + plane.length;
    void* const memory = ::mmap(nullptr, size, PROT_READ, MAP_SHARED, plane.fd.get(), 0);
    if (memory == MAP_FAILED)
      throw InputError(setup.where, 0, "buffers", "buffers that can be mapped", "others");
    mappings.push_back({buffer.get(), memory, size, plane.offset});
    auto request = camera->createRequest();
    if (!request || request->addBuffer(stream, buffer.get()) != 0)
      throw InputError(setup.where, 0, "buffers", "requests that the camera takes", "none");
    requests.push_back(std::move(request));
  }
}

LibcameraSource::Stream::~Stream() {
  if (started) camera->stop();
  if (connected) camera->requestCompleted.disconnect(this);
  for (const Mapping& mapping : mappings) ::munmap(mapping.memory, mapping.size);
  requests.clear();
  allocator.reset();
  configuration.reset();
  if (acquired) camera->release();
}

// Null where none came in time.
libcamera::Request* LibcameraSource::Stream::wait(int timeout_ms) {
  std::unique_lock<std::mutex> lock(mutex);
  arrived.wait_for(lock, std::chrono::milliseconds(timeout_ms), [this] { return finished_count > 0; });
  if (finished_count == 0) return nullptr;
  libcamera::Request* const oldest = finished.front();
  std::move(finished.begin() + 1, finished.begin() + static_cast<std::ptrdiff_t>(finished_count),
            finished.begin());
  --finished_count;
  return oldest;
}

LibcameraSource::LibcameraSource(CameraSetup setup)
    : setup_(std::move(setup)), layout_(&layout_of(setup_)), shape_(shape_of(setup_)) {
  if (!libcamera_format(*layout_).isValid())
    throw InputError(setup_.where, 0, "format", "one that libcamera has", setup_.format);
}

LibcameraSource::~LibcameraSource() = default;

void LibcameraSource::start() {
  stop();
  auto opened = std::make_unique<Stream>();
  opened->open(setup_, *layout_, shape_);
  stream_ = std::move(opened);
}

void LibcameraSource::stop() noexcept {
  stream_.reset();
}

Taken LibcameraSource::take(std::byte* pixels, int timeout_ms) noexcept {
  libcamera::Request* const request = stream_->wait(timeout_ms);
  if (request == nullptr)
    return {.status = any_gone(stream_->nodes) ? TakeStatus::kGone : TakeStatus::kSilence};
  const libcamera::FrameBuffer* const buffer = request->buffers().begin()->second;
  const libcamera::FrameMetadata& about = buffer->metadata();
  Taken taken{TakeStatus::kDamaged, static_cast<TimeNs>(about.timestamp), about.sequence};
  const Stream::Mapping* const mapping = stream_->mapping_of(buffer);
  const auto stride = static_cast<std::ptrdiff_t>(stream_->configuration->at(0).stride);
  const std::size_t needed = static_cast<std::size_t>(stride) * static_cast<std::size_t>(shape_.height) *
                             static_cast<std::size_t>(binning(*layout_, setup_.bayer));
  if (about.status == libcamera::FrameMetadata::FrameSuccess && mapping != nullptr &&
      needed <= mapping->size - mapping->offset) {
    to_grey(*layout_, setup_.bayer, static_cast<const std::byte*>(mapping->memory) + mapping->offset, stride,
            shape_, pixels);
    taken.status = TakeStatus::kFrame;
  }
  request->reuse(libcamera::Request::ReuseBuffers);
  if (stream_->camera->queueRequest(request) != 0) taken.status = TakeStatus::kGone;
  return taken;
}

std::vector<LibcameraDescription> describe_libcameras() {
  const auto all = manager().cameras();
  std::vector<LibcameraDescription> descriptions;
  for (const auto& camera : all) {
    LibcameraDescription one{camera->id(), model_of(*camera), {}, {}};
    for (const auto role : {libcamera::StreamRole::Raw, libcamera::StreamRole::Viewfinder}) {
      const auto configuration = camera->generateConfiguration({role});
      if (!configuration || configuration->empty()) continue;
      const libcamera::StreamFormats& formats = configuration->at(0).formats();
      for (const libcamera::PixelFormat& format : formats.pixelformats()) {
        std::string line =
            (role == libcamera::StreamRole::Raw ? "raw " : "processed ") + format_name(format) + ":";
        for (const libcamera::Size& size : formats.sizes(format)) line += " " + size_text(size) + ",";
        line.pop_back();
        one.formats.push_back(std::move(line));
      }
    }
    for (const auto& [id, range] : camera->controls())
      one.controls.push_back(id->name() + ": " + range.toString());
    descriptions.push_back(std::move(one));
  }
  return descriptions;
}

}  // namespace omma
