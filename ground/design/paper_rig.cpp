#include "ground/design/paper_rig.hpp"

#include "fsw/kernel/input_error.hpp"
#include "ground/format.hpp"

namespace omma::ground {

PaperRig with_fields(const Rig& rig, const std::vector<double>& fields_deg) {
  PaperRig paper = whole_images(rig);
  if (fields_deg.empty()) return paper;
  if (fields_deg.size() != 1 && fields_deg.size() != rig.cameras.size()) {
    throw InputError("arguments", 0, "--field", "one field of view, or one for each camera",
                     format("%zu for %zu cameras", fields_deg.size(), rig.cameras.size()));
  }
  for (std::size_t c = 0; c < rig.cameras.size(); ++c)
    paper.half_field[c] = 0.5 * fields_deg[fields_deg.size() == 1 ? 0 : c] * std::numbers::pi / 180;
  return paper;
}

}  // namespace omma::ground
