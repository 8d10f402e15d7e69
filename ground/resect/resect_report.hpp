// How a resection is told: text for a person, JSON for a program, a picture for the eye.
#pragma once

#include <string>

#include "ground/resect/card_resector.hpp"

namespace omma::ground {

std::string resection_text(const Rig& rig, const Resection& resection, const DotLists& dots);

/// One JSON object; its members are listed in docs/resect.md.
std::string resection_json(const Rig& rig, const Resection& resection, const DotLists& dots);

/// Writes the image of one camera with its dots circled and its targets named.
void write_annotated(const std::string& file, const ImageView& image, const Rig& rig, std::size_t camera,
                     const TargetBody& body, const Resection& resection, const DotLists& dots);

}  // namespace omma::ground
