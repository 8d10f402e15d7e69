#include "components/camera/camera_setup_table.hpp"

namespace omma {
namespace {

std::vector<CameraControl> read_words(const TomlTable& camera, std::string_view key) {
  std::vector<CameraControl> words;
  if (const auto table = camera.table_if(key))
    for (const std::string& name : table->keys()) words.push_back({name, table->word(name)});
  return words;
}

BayerUse read_bayer(const TomlTable& camera) {
  const std::string use = camera.text("bayer", "grey");
  if (use == "grey") return BayerUse::kGrey;
  if (use == "green") return BayerUse::kGreen;
  if (use == "raw") return BayerUse::kRaw;
  throw camera.error("bayer", R"("grey", "green" or "raw")", use);
}

bool read_memory(const TomlTable& camera) {
  const std::string memory = camera.text("memory", "mmap");
  if (memory != "mmap" && memory != "dma-buf") throw camera.error("memory", R"("mmap" or "dma-buf")", memory);
  return memory == "dma-buf";
}

std::string read_memory_from(const TomlTable& camera, bool dma_buf) {
  std::string owner = camera.text("memory_from", "");
  if (!owner.empty() && !dma_buf)
    throw camera.error("memory_from", R"(memory = "dma-buf" beside it)", "mmap");
  return owner;
}

}  // namespace

CameraSetup read_camera_setup(const TomlTable& camera, int width, int height, double frame_rate_hz) {
  CameraSetup setup;
  setup.where = camera.file();
  setup.device = camera.text("device");
  setup.format = camera.text("format", "GREY");
  setup.width = width;
  setup.height = height;
  setup.frame_rate_hz = camera.number("device_rate_hz", {0, 1000}, frame_rate_hz);
  setup.bayer = read_bayer(camera);
  setup.bits = static_cast<int>(camera.integer("bits", {8, 16}, 0));
  setup.buffers = static_cast<int>(camera.integer("buffers", {2, 32}, setup.buffers));
  setup.dma_buf = read_memory(camera);
  setup.memory_from = read_memory_from(camera, setup.dma_buf);
  setup.timeout_ms = static_cast<int>(camera.integer("timeout_ms", {10, 60000}, setup.timeout_ms));
  setup.controls = read_words(camera, "controls");
  setup.control_names = read_words(camera, "control_names");
  return setup;
}

}  // namespace omma
