#include "tests/bench/room_of_cards.hpp"

#include <random>

#include "ground/calibrate/board_adjustment.hpp"

namespace omma {
namespace {

constexpr double kDistance = 1.2;  // of the cards from the middle of the room [m]

Pose facing_the_middle(const Eigen::Vector3d& direction) {
  const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), -direction);
  return {turn, kDistance * direction};
}

// A card of 16 targets, 0.4 m across, three of them raised.
std::vector<Eigen::Vector3d> card_points() {
  std::vector<Eigen::Vector3d> points;
  for (int k = 0; k < 16; ++k)
    points.emplace_back(-0.2 + 0.13 * (k % 4), -0.15 + 0.1 * (k / 4) + 0.01 * (k % 3), k % 5 == 0 ? 0.04 : 0);
  return points;
}

}  // namespace

RoomOfCards room_of_cards(const Rig& rig, int sets, double noise, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(-1, 1);
  RoomOfCards room;
  room.rig = rig;
  for (const RigCamera& camera : rig.cameras) room.truth.rig_from_camera.push_back(camera.rig_from_camera);
  for (const Eigen::Vector3d& side :
       {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(-1, 0, 0), Eigen::Vector3d(0, 1, 0),
        Eigen::Vector3d(0, -1, 0), Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0, 0, -1)})
    room.truth.room_from_body.push_back(facing_the_middle(side));
  room.bodies = static_cast<int>(room.truth.room_from_body.size());
  // The room is the first card's frame.
  const Pose room_from_middle = room.truth.room_from_body[0].inverse();
  for (Pose& body : room.truth.room_from_body) body = room_from_middle * body;
  for (int s = 0; s < sets; ++s) {
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized();
    const Eigen::Vector3d shift(0.2 * uniform(random), 0.2 * uniform(random), 0.2 * uniform(random));
    room.truth.rig_from_room.push_back(Pose{turn, shift} * room_from_middle.inverse());
    for (int c = 0; c < static_cast<int>(rig.cameras.size()); ++c) {
      const RigCamera& camera = rig.cameras[static_cast<std::size_t>(c)];
      for (int b = 0; b < room.bodies; ++b) {
        ground::BodyView view{s, c, b, {}, {}};
        ground::BoardView seen;
        const Pose camera_from_body = camera.rig_from_camera.inverse() * room.truth.rig_from_room.back() *
                                      room.truth.room_from_body[static_cast<std::size_t>(b)];
        const bool faces = (camera_from_body.inverse() * Eigen::Vector3d::Zero()).z() > 0;
        for (const Eigen::Vector3d& point : card_points()) {
          Eigen::Vector2d pixel;
          const Eigen::Vector3d direction = (camera_from_body * point).normalized();
          if (!faces || direction.z() < 0.25 || !camera.lens.project(direction, pixel)) break;
          if (pixel.minCoeff() < 2 || pixel.x() > camera.lens.width() - 3 ||
              pixel.y() > camera.lens.height() - 3)
            break;
          pixel += noise * Eigen::Vector2d(normal(random), normal(random));
          view.sights.push_back({s, c, b, point, pixel, noise * noise * Eigen::Matrix2d::Identity()});
          seen.points.push_back(point);
          seen.pixels.push_back(pixel);
        }
        if (seen.points.size() < card_points().size()) continue;
        const std::optional<Pose> pose = ground::board_pose(seen, camera.lens);
        if (!pose) continue;
        view.camera_from_body = *pose;
        room.views.push_back(view);
      }
    }
  }
  return room;
}

}  // namespace omma
