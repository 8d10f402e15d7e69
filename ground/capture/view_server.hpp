// Live cameras in a browser: a page, and what it is made of, by HTTP (libmicrohttpd).
//
//   /                        the page; it needs nothing but this server
//   /status.json             each camera: size, frame rate, exposure, gain, what was lost
//   /camera/NAME.mjpg        its frames one after the other (multipart JPEG), as fast as they come and are
//   taken /camera/NAME.jpg         the next frame ?width=N&stretch=0       at most so wide, its brightest
//   pixels kept; levels as they are, not stretched
#pragma once

#include <memory>
#include <string>

#include "ground/capture/recorder.hpp"
#include "ground/capture/view_address.hpp"

namespace omma::ground {

class ViewServer {
 public:
  /// Serves until it is destroyed, from threads of its own. A reader that is slow is given fewer frames,
  /// nobody waits for it.
  /// @param recorders  outlive this object
  /// @throws InputError as listen_at
  ViewServer(Recorders& recorders, ViewAddress address);
  ~ViewServer();
  ViewServer(const ViewServer&) = delete;
  ViewServer& operator=(const ViewServer&) = delete;

  /// With the port that was taken.
  const ViewAddress& address() const;

 private:
  struct Daemon;
  std::unique_ptr<Daemon> daemon_;
};

/// What /status.json says.
std::string view_status(Recorders& recorders);

}  // namespace omma::ground
