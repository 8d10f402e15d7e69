// Charts of a page as pictures beside it.
#include "ground/page/chart_pictures.hpp"

#include <cairo.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "fsw/kernel/input_error.hpp"
#include "ground/page/page.hpp"
#include "ground/page/xy_chart.hpp"

namespace omma::ground {
namespace {

namespace fs = std::filesystem;

struct Reading {
  const std::vector<std::uint8_t>& bytes;
  std::size_t at = 0;
};

cairo_status_t read(void* closure, unsigned char* data, unsigned int length) {
  auto* reading = static_cast<Reading*>(closure);
  if (reading->at + length > reading->bytes.size()) return CAIRO_STATUS_READ_ERROR;
  std::memcpy(data, reading->bytes.data() + reading->at, length);
  reading->at += length;
  return CAIRO_STATUS_SUCCESS;
}

// A PNG, decoded.
class Picture {
 public:
  explicit Picture(const std::vector<std::uint8_t>& png) {
    Reading reading{png};
    surface_ = {cairo_image_surface_create_from_png_stream(read, &reading), cairo_surface_destroy};
  }
  int width() const { return cairo_image_surface_get_width(surface_.get()); }
  int height() const { return cairo_image_surface_get_height(surface_.get()); }
  std::uint32_t pixel(double u, double v) const {
    std::uint32_t value = 0;
    std::memcpy(&value,
                cairo_image_surface_get_data(surface_.get()) +
                    static_cast<std::ptrdiff_t>(v) * cairo_image_surface_get_stride(surface_.get()) +
                    4 * static_cast<std::ptrdiff_t>(u),
                4);
    return value & 0xFFFFFFU;
  }
  // Pixels of a box that are no paper.
  long ink(int left, int top, int right, int bottom) const {
    long count = 0;
    for (int v = top; v < bottom; ++v)
      for (int u = left; u < right; ++u) count += pixel(u, v) != 0xFFFFFFU ? 1 : 0;
    return count;
  }

 private:
  std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> surface_{nullptr, cairo_surface_destroy};
};

// A level line in the middle of the chart.
std::string level_chart(const std::string& title) {
  return xy_chart({title,
                   {"angle [&deg;]", false, 0, 10},
                   {"&sigma;&sup2; &plusmn; 1&Prime;", false, 0, 2},
                   {{"", "a", Mark::kLine, {{0, 1}, {10, 1}}}},
                   false});
}

TEST(ChartPictures, LookLikeTheChart) {
  const Picture picture(chart_png(level_chart("Level"), 2));
  EXPECT_EQ(picture.width(), 2 * 420);
  EXPECT_EQ(picture.height(), 2 * 250);
  // The line lies halfway between the title's 26 units and the labels' 38.
  const double middle = 26 + 0.5 * (250 - 26 - 38);
  EXPECT_EQ(picture.pixel(2 * 213.0, 2 * middle), 0x0B6BCBU);  // between two grid lines
  EXPECT_EQ(picture.pixel(2 * 213.0, 2 * middle - 12), 0xFFFFFFU);
  EXPECT_GT(picture.ink(0, 0, 120, 36), 50);                    // the title
  EXPECT_GT(picture.ink(300, 2 * 250 - 26, 560, 2 * 250), 50);  // the label of the x axis
}

TEST(ChartPictures, WriteWhatHtmlHasNamesFor) {
  EXPECT_NO_THROW(
      chart_png(level_chart("&chi; &eacute; &micro; &middot; &ndash; &radic; &times; &amp; &lt; &#39;")));
}

TEST(ChartPictures, AreNamedByTheirTitles) {
  const std::string page = page_head("t", "h", "l") + "<div class='charts'>" +
                           level_chart("About rig x <tspan class='unit'>[arcsec]</tspan>") +
                           level_chart("Speed, &sigma; of 3") + level_chart("Speed of 3") +
                           level_chart("&sup2;") + "</div>" + page_end();
  std::vector<std::string> names;
  for (const Chart& chart : charts_of(page)) names.push_back(chart.name);
  EXPECT_EQ(names, (std::vector<std::string>{"about_rig_x", "speed_of_3", "speed_of_3_2", "chart"}));
}

TEST(ChartPictures, StandBesideThePage) {
  const fs::path folder = fs::path(testing::TempDir()) / ("omma_chart_pictures_" + std::to_string(getpid()));
  fs::create_directories(folder);
  write_page((folder / "study.html").string(), level_chart("One") + level_chart("Two"));
  EXPECT_TRUE(fs::exists(folder / "study.html"));
  EXPECT_GT(fs::file_size(folder / "study_one.png"), 1000U);
  EXPECT_GT(fs::file_size(folder / "study_two.png"), 1000U);
  EXPECT_THROW(write_page((folder / "none" / "study.html").string(), ""), InputError);
  fs::remove_all(folder);
}

TEST(ChartPictures, RefuseWhatIsNoChart) {
  EXPECT_THROW(chart_png("<svg viewBox='0 0 10 10'><text>&unknown;</text></svg>"), std::runtime_error);
  EXPECT_THROW(chart_png("<svg viewBox='0 0 10 10'><text></svg>"), std::runtime_error);
  EXPECT_THROW(chart_png("<svg></svg>"), std::runtime_error);
}

}  // namespace
}  // namespace omma::ground
