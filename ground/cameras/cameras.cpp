#include "ground/cameras/cameras.hpp"

#include <cstdio>
#include <cstring>
#include <memory>
#include <string>

#include "fsw/kernel/input_error.hpp"
#include "hal/libcamera/libcamera_child.hpp"
#include "hal/live/pixel_layout.hpp"
#include "hal/v4l2/lent_memory.hpp"
#include "hal/v4l2/v4l2_controls.hpp"
#include "hal/v4l2/v4l2_device.hpp"

namespace omma::ground {
namespace {

void print_formats(const v4l2::Description& camera) {
  for (const v4l2::Format& format : camera.formats) {
    std::string sizes;
    for (const std::string& size : format.sizes) sizes += (sizes.empty() ? "" : ", ") + size;
    std::printf("  format  %-5s %s  %s%s\n", format.name.c_str(), format.description.c_str(), sizes.c_str(),
                find_pixel_layout(format.name) == nullptr ? "  (not understood)" : "");
  }
}

// Our name for a control of the device's, where it has one.
std::string our_name(const std::string& name) {
  for (const char* const ours : {"exposure", "gain", "blacklevel", "gamma", "trigger"})
    for (const std::string_view usual : v4l2::usual_names(ours))
      if (usual == name) return ours;
  return {};
}

void print_controls(const v4l2::Description& camera) {
  for (const v4l2::Control& control : camera.controls) {
    const std::string ours = our_name(control.name);
    std::printf("  control %-32s", control.name.c_str());
    if (control.type == V4L2_CTRL_TYPE_BUTTON) {
      std::printf(" button\n");
      continue;
    }
    std::printf(" %lld, %lld to %lld", static_cast<long long>(control.value),
                static_cast<long long>(control.least), static_cast<long long>(control.most));
    if (control.step > 1) std::printf(" in steps of %llu", static_cast<unsigned long long>(control.step));
    std::printf(", usually %lld%s", static_cast<long long>(control.usual),
                control.read_only ? ", read-only" : "");
    if (!ours.empty() && ours != control.name) std::printf("  (\"%s\")", ours.c_str());
    std::printf("\n");
    for (const auto& [value, item] : control.items)
      std::printf("          %30lld = \"%s\"\n", static_cast<long long>(value), item.c_str());
  }
}

void print_table(const v4l2::Description& camera) {
  for (const v4l2::Format& format : camera.formats) {
    if (find_pixel_layout(format.name) == nullptr) continue;
    std::printf("  in a mission:  driver = \"v4l2\", device = \"%s\", format = \"%s\"\n", camera.path.c_str(),
                format.name.c_str());
    return;
  }
}

int list_by_libcamera() {
  std::vector<LibcameraDescription> cameras;
  try {
    cameras = list_libcameras();
  } catch (const std::exception& error) {  // the rest of the list is worth having
    std::printf("%s\n", error.what());
  }
  for (const LibcameraDescription& camera : cameras) {
    std::printf("%s  \"%s\" (libcamera)\n", camera.id.c_str(), camera.model.c_str());
    for (const std::string& format : camera.formats) std::printf("  format  %s\n", format.c_str());
    for (const std::string& control : camera.controls) std::printf("  control %s\n", control.c_str());
    std::printf("  in a mission:  driver = \"libcamera\", device = \"%s\"\n", camera.id.c_str());
  }
  return static_cast<int>(cameras.size());
}

int list_cameras(const std::string& only) {
  int found = 0;
  for (const std::string& path : only.empty() ? v4l2::device_paths() : std::vector<std::string>{only}) {
    v4l2::Device device;
    v4l2_capability capability{};
    const int error = device.open(path);
    if (error != 0 && !only.empty())
      throw InputError(path, 0, "device", "a video device", std::strerror(error));
    if (error != 0 || !v4l2::captures(device, capability)) {
      if (!only.empty()) throw InputError(path, 0, "device", "a video device that captures", "another one");
      continue;
    }
    const v4l2::Description camera = v4l2::describe(device, path);
    std::printf("%s  \"%s\" at %s, driver %s (V4L2)\n", path.c_str(), camera.card.c_str(), camera.bus.c_str(),
                camera.driver.c_str());
    std::printf("  memory  %s\n", camera.memory.c_str());
    print_formats(camera);
    print_controls(camera);
    print_table(camera);
    ++found;
  }
  if (only.empty()) {
    found += list_by_libcamera();
    for (const std::string& heap : dma_heaps())
      std::printf("%s  DMA heap (memory_from, for devices that take memory of another owner's)\n",
                  heap.c_str());
  }
  if (found == 0) std::printf("no camera found: no /dev/video* captures\n");
  return found > 0 ? 0 : 1;
}

}  // namespace

void add_cameras(CLI::App& app, CommandContext& context) {
  auto device = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("cameras", "List cameras, their formats and controls");
  command->add_option("device", *device, "Only this one, for instance /dev/video0");
  command->callback([device, &context] { context.exit_code = list_cameras(*device); });
}

}  // namespace omma::ground
