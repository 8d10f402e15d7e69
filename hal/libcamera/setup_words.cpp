#include "hal/libcamera/setup_words.hpp"

#include <charconv>
#include <string_view>

#include "fsw/kernel/input_error.hpp"

namespace omma {
namespace {

[[noreturn]] void refuse(std::string_view word) {
  throw InputError("omma-libcamera", 0, "setup", "key=value of a camera's setup", word);
}

int number(std::string_view word, std::string_view value) {
  int result = 0;
  const char* const end = value.data() + value.size();
  const auto [stop, error] = std::from_chars(value.data(), end, result);
  if (error != std::errc{} || stop != end) refuse(word);
  return result;
}

CameraControl control(std::string_view word, std::string_view value) {
  const std::size_t equals = value.find('=');
  if (equals == std::string_view::npos) refuse(word);
  return {std::string(value.substr(0, equals)), std::string(value.substr(equals + 1))};
}

void read_word(std::string_view word, CameraSetup& setup) {
  const std::size_t equals = word.find('=');
  if (equals == std::string_view::npos) refuse(word);
  const std::string_view key = word.substr(0, equals);
  const std::string_view value = word.substr(equals + 1);
  if (key == "where")
    setup.where = value;
  else if (key == "device")
    setup.device = value;
  else if (key == "format")
    setup.format = value;
  else if (key == "width")
    setup.width = number(word, value);
  else if (key == "height")
    setup.height = number(word, value);
  else if (key == "bayer")
    setup.bayer = static_cast<BayerUse>(number(word, value));
  else if (key == "bits")
    setup.bits = number(word, value);
  else if (key == "buffers")
    setup.buffers = number(word, value);
  else if (key == "control")
    setup.controls.push_back(control(word, value));
  else if (key == "control_name")
    setup.control_names.push_back(control(word, value));
  else
    refuse(word);
}

}  // namespace

std::vector<std::string> words_of(const CameraSetup& setup) {
  std::vector<std::string> words{"where=" + setup.where,
                                 "device=" + setup.device,
                                 "format=" + setup.format,
                                 "width=" + std::to_string(setup.width),
                                 "height=" + std::to_string(setup.height),
                                 "bayer=" + std::to_string(static_cast<int>(setup.bayer)),
                                 "bits=" + std::to_string(setup.bits),
                                 "buffers=" + std::to_string(setup.buffers)};
  for (const CameraControl& one : setup.controls) words.push_back("control=" + one.name + "=" + one.value);
  for (const CameraControl& one : setup.control_names)
    words.push_back("control_name=" + one.name + "=" + one.value);
  return words;
}

CameraSetup setup_of_words(const std::vector<std::string>& words) {
  CameraSetup setup;
  for (const std::string& word : words) read_word(word, setup);
  return setup;
}

}  // namespace omma
