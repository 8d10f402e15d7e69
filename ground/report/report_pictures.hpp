// The report's pictures: the whole sky with its bright stars named, and one frame of each camera with what
// its dots were taken for.
#pragma once

#include <filesystem>

#include "components/catalogue/star_catalogue.hpp"
#include "ground/draw/canvas.hpp"
#include "ground/report/chunk_pictures.hpp"
#include "ground/report/flight_log.hpp"
#include "ground/report/flown_mission.hpp"

namespace omma::ground {

/// The panorama (fixed to the stars) with a grid and the names of the brightest stars that it shows.
Canvas panorama_picture(const ChunkPicture& panorama, const StarCatalogue& catalogue);

/// The frame with its dots: stars used (green, the brightest named), targets used (blue, named), pairs culled
/// (red), dots of no known thing (grey). A line of text below says how many of each.
/// @param image_file  the recorded frame
/// @throws InputError where it cannot be read
Canvas camera_picture(const std::filesystem::path& image_file, const FlownMission& mission,
                      const std::vector<omma_Dot>& dots, const std::string& camera, std::uint64_t frame);

}  // namespace omma::ground
