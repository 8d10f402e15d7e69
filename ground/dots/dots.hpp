// `omma dots`: the dots of one image by any of the extraction pipelines, with the images between the stages.
#pragma once

#include "ground/command.hpp"

namespace omma::ground {

void add_dots(CLI::App& app, CommandContext& context);

}  // namespace omma::ground
