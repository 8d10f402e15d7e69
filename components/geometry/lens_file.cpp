#include "components/geometry/lens_file.hpp"

#include <algorithm>
#include <stdexcept>

#include "fsw/kernel/input_error.hpp"
#include "fsw/services/text_input.hpp"

namespace omma {
namespace {

struct LensPath {
  std::string file;
  std::string camera;  // what follows '#'
};

LensPath split(const std::string& path) {
  std::error_code error;
  const std::size_t mark = path.rfind('#');
  if (mark == std::string::npos || std::filesystem::exists(path, error)) return {path, ""};
  return {path.substr(0, mark), path.substr(mark + 1)};
}

// A line that begins `name <sign>`, with blanks where the format allows them.
bool assigns(const std::string& text, std::string_view name, char sign) {
  for (std::string_view line : lines_of(text)) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    if (!line.starts_with(name)) continue;
    line.remove_prefix(name.size());
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    if (line.starts_with(sign)) return true;
  }
  return false;
}

}  // namespace

Lens read_lens_file(const std::string& path) {
  const auto [file, camera] = split(path);
  const std::string text = read_text(file);
  const std::string ending = std::filesystem::path(file).extension().string();
  const bool kalibr =
      ending == ".yaml" || ending == ".yml" || (ending != ".m" && assigns(text, "camera_model", ':'));
  if (!kalibr && !camera.empty()) {
    throw InputError(path, 0, "file", "a Kalibr camera chain before '#'", "another kind of file");
  }
  try {
    if (kalibr) return lens_from_kalibr(text, file, camera);
    if (ending == ".m" || assigns(text, "fc", '=') || assigns(text, "cc", '='))
      return lens_from_bouguet(text, file);
    return lens_from_ocamcalib(text, file);
  } catch (const std::invalid_argument& error) {  // numbers that are right one by one but make no lens
    throw InputError(path, 0, "lens", "a model that can be used", error.what());
  }
}

}  // namespace omma
