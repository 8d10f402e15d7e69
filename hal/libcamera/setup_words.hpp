// A camera's setup as a program's arguments, key=value each, and back.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "hal/camera_setup.hpp"

namespace omma {

std::vector<std::string> words_of(const CameraSetup& setup);
/// @throws InputError: a word that is none of a setup's
CameraSetup setup_of_words(std::span<const char* const> words);

}  // namespace omma
