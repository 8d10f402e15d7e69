#include "ground/resect/manual_pairs.hpp"

#include <algorithm>

#include "fsw/kernel/input_error.hpp"
#include "fsw/services/text_input.hpp"
#include "ground/format.hpp"

namespace omma::ground {
namespace {

constexpr std::size_t kFewestManualPairs = 4;

class PairLine {
 public:
  PairLine(std::string_view line, const std::string& file, int number, const Rig& rig)
      : words_(words_of(line)), file_(file), number_(number), rig_(rig) {
    const bool one_camera = rig.cameras.size() == 1 && words_.size() == 3;
    if (!one_camera && words_.size() != 4)
      throw error("pair", rig.cameras.size() == 1 ? "u v TARGET" : "CAMERA u v TARGET",
                  std::to_string(words_.size()) + " words");
    first_ = words_.size() - 3;
  }

  ManualPair pair(const TargetBody& body) const {
    ManualPair pair;
    pair.camera = first_ == 0 ? 0 : camera();
    const Lens& lens = rig_.cameras[pair.camera].lens;
    pair.pixel = {coordinate("u", 0, lens.width()), coordinate("v", 1, lens.height())};
    const std::string_view id = words_[first_ + 2];
    const auto at = std::find_if(body.targets.begin(), body.targets.end(),
                                 [id](const Target& target) { return target.id.view() == id; });
    if (at == body.targets.end()) throw error("target", "a target of the database", excerpt(id));
    pair.target = static_cast<std::size_t>(at - body.targets.begin());
    return pair;
  }

  InputError error(std::string_view field, std::string_view expected, std::string_view found) const {
    return {file_, number_, field, expected, found};
  }
  std::string target() const { return excerpt(words_[first_ + 2]); }

 private:
  std::size_t camera() const {
    for (std::size_t c = 0; c < rig_.cameras.size(); ++c)
      if (rig_.cameras[c].name.view() == words_[0]) return c;
    throw error("camera", "a camera of the rig", excerpt(words_[0]));
  }
  double coordinate(const char* name, std::size_t k, int size) const {
    const std::string_view word = words_[first_ + k];
    const auto value = finite_number(word);
    if (!value || *value < -0.5 || *value > size - 0.5)
      throw error(name, format("a pixel of the image, -0.5 to %.1f", size - 0.5), excerpt(word));
    return *value;
  }

  std::vector<std::string_view> words_;
  const std::string& file_;
  int number_;
  const Rig& rig_;
  std::size_t first_ = 0;
};

}  // namespace

std::vector<ManualPair> read_manual_pairs(const std::filesystem::path& file, const Rig& rig,
                                          const TargetBody& body) {
  const std::string text = read_text(file);
  const std::string name = file.string();
  std::vector<ManualPair> pairs;
  int number = 0;
  for (const std::string_view line : lines_of(text)) {
    ++number;
    if (line.find_first_not_of(" \t") == std::string_view::npos || line.starts_with('#')) continue;
    const PairLine entry(line, name, number, rig);
    const ManualPair pair = entry.pair(body);
    for (const ManualPair& other : pairs)
      if (other.camera == pair.camera && other.target == pair.target)
        throw entry.error("target", "each target once an image", entry.target() + " again");
    pairs.push_back(pair);
  }
  if (pairs.size() < kFewestManualPairs)
    throw InputError(name, 0, "pairs", "at least four", std::to_string(pairs.size()));
  return pairs;
}

}  // namespace omma::ground
