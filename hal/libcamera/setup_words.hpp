// A camera's setup as words, key=value each, and back.
#pragma once

#include <string>
#include <vector>

#include "hal/camera_setup.hpp"

namespace omma {

std::vector<std::string> words_of(const CameraSetup& setup);
/// @throws InputError: a word that is none of a setup's
CameraSetup setup_of_words(const std::vector<std::string>& words);

}  // namespace omma
