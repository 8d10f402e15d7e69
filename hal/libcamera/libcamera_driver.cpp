#include "hal/libcamera/libcamera_driver.hpp"

#include <dlfcn.h>

#include <filesystem>

#include "fsw/kernel/input_error.hpp"

namespace omma {
namespace {

constexpr const char* kModule = "omma-libcamera.so";

// Beside the program, or where the system looks. It stays loaded.
void* module_function(const char* name, const std::string& where) {
  std::error_code error;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
  void* module = ::dlopen((program.parent_path() / kModule).c_str(), RTLD_NOW | RTLD_LOCAL);
  if (module == nullptr) module = ::dlopen(kModule, RTLD_NOW | RTLD_LOCAL);
  void* const function = module == nullptr ? nullptr : ::dlsym(module, name);
  if (function == nullptr) {
    throw InputError(where, 0, "driver",
                     std::string("the module ") + kModule +
                         " of the driver libcamera, which is built where libcamera-dev is installed",
                     "none");
  }
  return function;
}

}  // namespace

std::unique_ptr<FrameSource> make_libcamera_source(const CameraSetup& setup) {
  auto* const make =
      reinterpret_cast<MakeLibcameraSource*>(module_function("omma_make_libcamera_source", setup.where));
  return std::unique_ptr<FrameSource>(make(setup));
}

std::vector<LibcameraDescription> list_libcameras() {
  std::vector<LibcameraDescription> cameras;
  reinterpret_cast<ListLibcameras*>(module_function("omma_list_libcameras", "libcamera"))(cameras);
  return cameras;
}

}  // namespace omma
