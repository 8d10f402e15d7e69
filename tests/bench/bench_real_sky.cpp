// omma-bench real_sky: the simulator beside a real photograph (Longyearbyen, from the shared data folder):
// with zero point, air, width of the spots, noise and background taken from the photograph, are as many stars
// found, as bright, and as wide?
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>

#include "components/catalogue/star_catalogue.hpp"
#include "components/extractor/background_map.hpp"
#include "components/extractor/dot_extractor.hpp"
#include "hal/recorded/image_file.hpp"
#include "sim/camera_renderer.hpp"
#include "sim/ground.hpp"
#include "tests/bench/benches.hpp"
#include "tests/bench/measure.hpp"
#include "tests/bench/options.hpp"
#include "tests/bench/photographs.hpp"
#include "tests/paths.hpp"

namespace omma {
namespace {

constexpr double kGate = 2;  // dot to star [px]
constexpr double kFaintest = 6.5;
constexpr double kRim = 78 * M_PI / 180;  // stars farther off axis are behind hills and haze

struct Star {
  SkyStar sky;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double angle = 0;  // off axis [rad]
  double airmass = 0;
  double colour = 0;  // B − V
};

struct Measured {
  std::vector<const Dot*> dot;  // of each star; nullptr: not found
  std::size_t dots = 0;
};

// Magnitude of grey levels less V: zero + air · airmass + colour · (B − V).
struct Photometry {
  Eigen::Vector3d terms = Eigen::Vector3d::Zero();
  double scatter = 0;
  int stars = 0;
};

// B − V of the Bright Star Catalogue by HR number (bsc5.dat, columns 1 to 4 and 110 to 114); 0 where it has
// none.
std::vector<double> colours(const std::string& data) {
  std::vector<double> colour(9111, 0);
  std::ifstream file(data + "/catalogue/bsc5.dat");
  for (std::string line; std::getline(file, line);) {
    const int hr = std::atoi(line.substr(0, 4).c_str());
    if (hr > 0 && hr < 9111 && line.size() > 114)
      colour[static_cast<std::size_t>(hr)] = std::atof(line.substr(109, 5).c_str());
  }
  return colour;
}

Eigen::Vector3d row_of(const Star& star) {
  return {1, star.airmass, star.colour};
}

std::vector<Star> stars_of(const Photograph& photograph, const StarCatalogue& catalogue,
                           const std::vector<double>& colour) {
  const Lens& lens = photograph.rig.cameras[0].lens;
  // The zenith: where stars are at the site, by the catalogue's own refraction, is not told; the camera looks
  // up.
  // The camera looks to the zenith within a few degrees: the angle off axis stands for that from the zenith.
  std::vector<Star> stars;
  for (const SkyStar& sky : catalogue.stars()) {
    Star star{sky, {}, 0, 0, colour[sky.hr]};
    const Eigen::Vector3d direction = photograph.rig_from_j2000 * sky.direction;
    star.angle = std::acos(std::min(1.0, direction.z()));
    if (star.angle > kRim || !lens.project(direction, star.pixel)) continue;
    star.airmass = sim::Ground::airmass(0.5 * M_PI - star.angle);
    stars.push_back(star);
  }
  return stars;
}

Measured measure(const DotList& list, const std::vector<Star>& stars) {
  Measured m;
  m.dots = list.dots.size();
  for (const Star& star : stars) {
    const Dot* nearest = nullptr;
    for (const Dot& dot : list.dots) {
      const double distance = (dot.pixel - star.pixel).norm();
      if (distance < kGate && (nearest == nullptr || distance < (nearest->pixel - star.pixel).norm()))
        nearest = &dot;
    }
    m.dot.push_back(nearest);
  }
  return m;
}

double brightness(const Dot& dot) {
  return -2.5 * std::log10(dot.flux);
}

bool good(const Dot* dot, const Star& star) {
  return dot != nullptr && (dot->flags & kDotSaturated) == 0 && dot->snr > 12 && star.sky.magnitude < 4.5;
}

// Least squares, what is beyond three deviations left out three times.
Photometry fit(const Measured& m, const std::vector<Star>& stars) {
  Photometry p;
  p.scatter = 10;
  const auto rest = [&](std::size_t i) {
    return brightness(*m.dot[i]) - stars[i].sky.magnitude - p.terms.dot(row_of(stars[i]));
  };
  for (int pass = 0; pass < 4; ++pass) {
    Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
    Eigen::Vector3d b = Eigen::Vector3d::Zero();
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < stars.size(); ++i) {
      if (!good(m.dot[i], stars[i]) || (pass > 0 && std::abs(rest(i)) > 3 * p.scatter)) continue;
      kept.push_back(i);
      a += row_of(stars[i]) * row_of(stars[i]).transpose();
      b += row_of(stars[i]) * (brightness(*m.dot[i]) - stars[i].sky.magnitude);
    }
    p.terms = a.inverse() * b;
    double squares = 0;
    for (const std::size_t i : kept) squares += rest(i) * rest(i);
    p.stars = static_cast<int>(kept.size());
    p.scatter = std::sqrt(squares / std::max(1, p.stars - 3));
  }
  return p;
}

double width_of(const Dot& dot) {
  return std::sqrt(double{dot.sigma_major} * dot.sigma_minor);
}

double median_width(const Measured& m, const std::vector<Star>& stars, double from, double to) {
  std::vector<double> widths;
  for (std::size_t i = 0; i < stars.size(); ++i) {
    if (good(m.dot[i], stars[i]) && stars[i].angle >= from && stars[i].angle < to)
      widths.push_back(width_of(*m.dot[i]));
  }
  return quantile(widths, 0.5);
}

// Electrons per grey level from how the noise grows with the background, and the noise of no light.
void find_gain(const BackgroundMap& map, const Lens& lens, sim::Sensor& sensor) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (int v = 100; v < lens.height() - 100; v += 24) {
    for (int u = 100; u < lens.width() - 100; u += 24) {
      Eigen::Vector3d ray;
      if (!lens.bearing({u, v}, ray) || ray.z() < std::cos(kRim)) continue;
      const double level = map.level(static_cast<float>(u), static_cast<float>(v));
      const double variance = std::pow(map.noise(static_cast<float>(u), static_cast<float>(v)), 2);
      n += 1;
      sx += level;
      sy += variance;
      sxx += level * level;
      sxy += level * variance;
    }
  }
  const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
  sensor.gain = slope > 0 ? 1 / slope : sx / sy;  // no slope to see: all shot noise
  const double dark = (sy - sx / sensor.gain) / n;
  sensor.read_noise = sensor.gain * std::sqrt(std::max(0.05, dark));
}

}  // namespace

int bench_real_sky(Options& options) {
  std::string data = OMMA_SHARED_DATA "/data";
  int fill_percent = 100;
  options.add("--data", data, "the shared data folder");
  options.add("--fill-percent", fill_percent, "of a pixel's area that sees light");
  options.read();
  const auto list = photographs(data, PhotographGroup::kLongyearbyen);
  if (list.empty()) {
    std::printf("no photograph in %s\n", data.c_str());
    return 1;
  }
  const Photograph& photograph = list.front();
  const Lens& lens = photograph.rig.cameras[0].lens;
  const Image image = read_image(photograph.images[0]);
  const auto catalogue = std::make_unique<StarCatalogue>(
      photograph.observer, StarCatalogueParameters{static_cast<float>(kFaintest), 2 * lens.pixel_angle()});
  const std::vector<Star> stars = stars_of(photograph, *catalogue, colours(data));
  auto extractor = std::make_unique<DotExtractor>(image.width, image.height);
  auto real_dots = std::make_unique<DotList>();
  extractor->extract(image.view(), {}, *real_dots);
  const Measured real = measure(*real_dots, stars);
  const Photometry seen = fit(real, stars);

  sim::Scenario scenario;
  scenario.rig = photograph.rig;
  sim::Sensor& sensor = scenario.sensors[0];
  sensor.bits = image.white_level > 255 ? 16 : 8;
  sensor.exposure = 1;
  sensor.field = M_PI;
  BackgroundMap map(image.width, image.height);
  map.build(image.view(), false);
  find_gain(map, lens, sensor);
  sensor.full_well = 1e9;
  sensor.fill_factor = 0.01 * fill_percent;
  sensor.zero_point = sensor.gain * std::pow(10, -0.4 * seen.terms[0]) / sensor.fill_factor;
  sensor.psf_sigma = median_width(real, stars, 0, kRim);
  scenario.rig_motion = sim::Motion::constant(
      {Eigen::Quaterniond(photograph.rig_from_j2000.transpose()), {0, 0, 0}}, {0, 0, 0}, {0, 0, 0});
  std::vector<SkyStar> dimmed;
  // The photograph's brightnesses scatter more than light and noise make: spots of 0.4 px on a mosaic of
  // colour filters. The simulator has no mosaic; it is given the scatter.
  const sim::RandomSequence random(7, 0, 0);
  for (std::size_t i = 0; i < stars.size(); ++i) {
    dimmed.push_back(stars[i].sky);
    dimmed.back().magnitude +=
        static_cast<float>(seen.terms[1] * stars[i].airmass + seen.terms[2] * stars[i].colour +
                           seen.scatter * sim::normal_table()(static_cast<std::uint32_t>(random[i])));
  }
  const sim::CameraView view(scenario.rig.cameras[0], sensor, 1, 0);
  sim::CameraRenderer renderer(scenario, dimmed, view, 0);
  renderer.draw(0);
  std::vector<float> electrons(renderer.mean_electrons().begin(), renderer.mean_electrons().end());
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u)
      electrons[static_cast<std::size_t>(v) * static_cast<std::size_t>(image.width) +
                static_cast<std::size_t>(u)] +=
          std::max(0.0F,
                   static_cast<float>(sensor.gain) * map.level(static_cast<float>(u), static_cast<float>(v)));
  }
  Image drawn;
  drawn.resize(image.width, image.height, sensor.bits > 8 ? PixelFormat::kGrey16 : PixelFormat::kGrey8);
  drawn.white_level = sensor.white_level();
  if (sensor.bits > 8)
    sim::read_out<std::uint16_t>(sensor, electrons, {}, sim::RandomSequence(1, 0, 0), 0,
                                 {reinterpret_cast<std::uint16_t*>(drawn.pixels.data()), electrons.size()});
  else
    sim::read_out<std::uint8_t>(sensor, electrons, {}, sim::RandomSequence(1, 0, 0), 0,
                                {reinterpret_cast<std::uint8_t*>(drawn.pixels.data()), electrons.size()});
  auto drawn_dots = std::make_unique<DotList>();
  extractor->extract(drawn.view(), {}, *drawn_dots);
  const Measured simulated = measure(*drawn_dots, stars);
  const Photometry back = fit(simulated, stars);

  std::printf(
      "%s: %d x %d, %d bit; %.3g electrons a grey level, noise of no light %.2f levels, spots of %.2f px\n",
      photograph.name.c_str(), image.width, image.height, sensor.bits, sensor.gain,
      sensor.read_noise / sensor.gain, sensor.psf_sigma);
  std::printf("%-28s %12s %12s\n", "", "photograph", "simulation");
  std::printf("%-28s %12zu %12zu\n", "dots", real.dots, simulated.dots);
  for (int v = 1; v <= 6; ++v) {
    int all = 0, a = 0, b = 0;
    for (std::size_t i = 0; i < stars.size(); ++i) {
      const double magnitude = stars[i].sky.magnitude;
      if (magnitude >= v + 0.5 || (v > 1 && magnitude < v - 0.5)) continue;
      ++all;
      a += real.dot[i] != nullptr ? 1 : 0;
      b += simulated.dot[i] != nullptr ? 1 : 0;
    }
    std::printf("stars V %-3.1f to %-3.1f, of %-7d %12d %12d\n", v > 1 ? v - 0.5 : -1.5, v + 0.5, all, a, b);
  }
  std::printf("%-28s %12.3f %12.3f\n", "zero point [mag]", seen.terms[0], back.terms[0]);
  std::printf("%-28s %12.3f %12.3f\n", "air [mag per air mass]", seen.terms[1], back.terms[1]);
  std::printf("%-28s %12.3f %12.3f\n", "colour [mag per B-V]", seen.terms[2], back.terms[2]);
  std::printf("%-28s %12.3f %12.3f\n", "scatter of brightness [mag]", seen.scatter, back.scatter);
  for (int ring = 0; ring < 3; ++ring)
    std::printf("width %2d to %2d deg off axis   %12.3f %12.3f px\n", 26 * ring, 26 * (ring + 1),
                median_width(real, stars, 26 * ring * M_PI / 180, 26 * (ring + 1) * M_PI / 180),
                median_width(simulated, stars, 26 * ring * M_PI / 180, 26 * (ring + 1) * M_PI / 180));
  return 0;
}

}  // namespace omma
