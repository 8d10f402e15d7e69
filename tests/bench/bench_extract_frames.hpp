// `omma-bench extract --frames`: the extractor on rendered frames with truth.
#pragma once

#include <string>

namespace omma {

/// Where the frames are, and which of them are looked at.
struct RenderedFrames {
  std::string folder;
  std::string mission = "config/demo.toml";
  int every = 6;
  int shown = -1;  ///< frame whose missed spots are listed
};

int bench_extract_frames(const RenderedFrames& rendered);

}  // namespace omma
