#include "ground/calibrate/rig_calibration.hpp"

#include <algorithm>
#include <optional>

#include "ground/format.hpp"

namespace omma::ground {
namespace {

using Places = std::vector<std::optional<Pose>>;

// Everything that a chain of views ties to camera 0 and body 0: a view joins camera, set and body, and gives
// any one of them from the two others.
class Chain {
 public:
  Chain(const Rig& rig, int bodies, int sets)
      : cameras(rig.cameras.size()),
        bodies_(static_cast<std::size_t>(bodies)),
        sets_(static_cast<std::size_t>(sets)) {
    cameras[0] = rig.cameras[0].rig_from_camera;
    bodies_[0] = Pose{};
  }

  // @return whether the view placed something
  bool follow(const BodyView& view) {
    auto& camera = cameras[static_cast<std::size_t>(view.camera)];
    auto& body = bodies_[static_cast<std::size_t>(view.body)];
    auto& set = sets_[static_cast<std::size_t>(view.set)];
    if (camera && body && !set) {
      set = *camera * view.camera_from_body * body->inverse();
    } else if (camera && !body && set) {
      body = set->inverse() * *camera * view.camera_from_body;
    } else if (!camera && body && set) {
      camera = *set * *body * view.camera_from_body.inverse();
    } else {
      return false;
    }
    return true;
  }

  Places cameras;
  const Places& bodies() const { return bodies_; }
  const Places& sets() const { return sets_; }

 private:
  Places bodies_;
  Places sets_;
};

// Where no view ties anything more to what is placed, the next camera stands where the rig's file has it.
void follow_all(Chain& chain, const Rig& guess, const std::vector<BodyView>& views) {
  for (std::size_t next = 0; next <= guess.cameras.size(); ++next) {
    for (bool placed = true; placed;) {
      placed = false;
      for (const BodyView& view : views) placed = chain.follow(view) || placed;
    }
    if (next < guess.cameras.size() && !chain.cameras[next])
      chain.cameras[next] = guess.cameras[next].rig_from_camera;
  }
}

bool take(const Places& places, std::vector<Pose>& poses) {
  for (const std::optional<Pose>& place : places) {
    if (!place) return false;
    poses.push_back(*place);
  }
  return true;
}

std::string loose(const Rig& rig, const Chain& chain, const std::vector<BodyView>& views) {
  for (std::size_t c = 0; c < rig.cameras.size(); ++c) {
    const bool saw = std::any_of(views.begin(), views.end(),
                                 [&](const BodyView& view) { return view.camera == static_cast<int>(c); });
    if (!saw) return format("camera %s saw no card in any image", rig.cameras[c].name.c_str());
  }
  for (std::size_t b = 0; b < chain.bodies().size(); ++b) {
    if (!chain.bodies()[b])
      return format("no chain of images ties card %zu to the first: let both be seen in one frame set",
                    b + 1);
  }
  return "no chain of images ties a frame set to the others";
}

// The dissertation's way, with bodies where the adjustment has them: one image of camera c, one of camera 0.
std::optional<Pose> from_one_image(int camera, const std::vector<BodyView>& views, const RigGeometry& g) {
  for (const BodyView& mine : views) {
    if (mine.camera != camera) continue;
    for (const BodyView& first : views) {
      if (first.camera != 0 || first.set != mine.set) continue;
      const Pose rig_from_room = g.rig_from_camera[0] * first.camera_from_body *
                                 g.room_from_body[static_cast<std::size_t>(first.body)].inverse();
      return rig_from_room * g.room_from_body[static_cast<std::size_t>(mine.body)] *
             mine.camera_from_body.inverse();
    }
  }
  return std::nullopt;
}

int set_count(const std::vector<BodyView>& views) {
  int sets = 0;
  for (const BodyView& view : views) sets = std::max(sets, view.set + 1);
  return sets;
}

}  // namespace

RigCalibration calibrate_rig(const Rig& rig, int bodies, const std::vector<BodyView>& views,
                             const RigAdjustmentOptions& options) {
  RigCalibration result;
  result.rig = rig;
  Chain chain(rig, bodies, set_count(views));
  follow_all(chain, rig, views);
  RigGeometry start;
  const bool all_saw = std::all_of(rig.cameras.begin(), rig.cameras.end(), [&](const RigCamera& camera) {
    return std::any_of(views.begin(), views.end(), [&](const BodyView& view) {
      return &rig.cameras[static_cast<std::size_t>(view.camera)] == &camera;
    });
  });
  if (!all_saw || !take(chain.cameras, start.rig_from_camera) ||
      !take(chain.bodies(), start.room_from_body) || !take(chain.sets(), start.rig_from_room)) {
    result.reason = loose(rig, chain, views);
    return result;
  }
  for (const BodyView& view : views)
    result.sights.insert(result.sights.end(), view.sights.begin(), view.sights.end());
  result.adjustment = adjust_rig(rig, start, result.sights, options);
  if (!result.adjustment.converged) {
    result.reason = "the adjustment did not converge: too few or too like views";
    return result;
  }
  for (std::size_t c = 0; c < rig.cameras.size(); ++c) {
    result.rig.cameras[c].rig_from_camera = result.adjustment.geometry.rig_from_camera[c];
    result.one_image.push_back(
        c == 0 ? std::nullopt : from_one_image(static_cast<int>(c), views, result.adjustment.geometry));
  }
  result.done = true;
  return result;
}

}  // namespace omma::ground
