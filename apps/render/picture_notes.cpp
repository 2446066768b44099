#include "apps/render/picture_notes.h"

#include <cmath>

#include "apps/formats/whole_view.h"
#include "apps/frontend/line/number_text.h"
#include "apps/scene/scene_setup.h"
#include "core/base/expect.h"

namespace dmpc::apps {

namespace {

/// A picture whose brightest pixel has fewer of the film's steps is off by more than a 512th, so that 8 bits may show it.
constexpr double steps_min = 256;

std::string cut_note(const core::Film& film, const core::FilmRange& range) {
  return grouped(range.pixels_cut) + " of " + counted(film.pixel_count(), "pixel") +
         " are brighter than the film can hold and were clipped, from a radiance of " + rounded(range.cut_from) +
         " on, so that their colours are wrong, too: lights that are weaker by a power of two keep all other bits";
}

std::string dark_note(const core::Film& film, const core::FilmRange& range) {
  return "no pixel is brighter than " + rounded(range.brightest) + ", and the film counts light in steps of " +
         rounded(film.step()) + ", so that pixels are off by " + percent_text(50 * film.step() / range.brightest) +
         " and more: something else in the scene is far brighter, lights or materials that are not visible";
}

std::string black_note(const core::Film& film, std::uint64_t lit) {
  return "the picture is black, though " + counted(lit, "shadow ray") +
         " reached a light: each contributed less than half of the film's steps of " + rounded(film.step());
}

std::string rounded_text(const core::Vec3d& point) { return rounded(point.x) + "," + rounded(point.y) + "," + rounded(point.z); }

/// A single point has a sphere, too, or its camera would stand in it.
BoundingSphere sphere_around(const core::Box& bounds) {
  const double radius = 0.5 * length(bounds.high - bounds.low);
  return {bounds.center(), radius > 0 ? radius : 1};
}

}  // namespace

std::vector<std::string> film_notes(const core::Film& film, std::uint64_t lit) {
  const core::FilmRange range = range_of(film);
  std::vector<std::string> notes;
  if (range.pixels_cut > 0) {
    notes.push_back(cut_note(film, range));
  }
  if (range.brightest > 0 && range.brightest < steps_min * film.step()) {
    notes.push_back(dark_note(film, range));
  } else if (range.brightest == 0 && lit > 0) {
    notes.push_back(black_note(film, lit));
  }
  return notes;
}

UpAxis up_of(const core::View& view) {
  UpAxis up{0, view.up.x < 0};
  for (std::size_t axis = 1; axis < 3; ++axis) {
    if (std::fabs(view.up[axis]) > std::fabs(view.up[up.axis])) {
      up = {axis, view.up[axis] < 0};
    }
  }
  return up;
}

std::string small_note(double share, const core::Box& bounds, const UpAxis& up) {
  core::expect(!bounds.empty(), "a scene that may be seen has bounds");
  const core::View view = whole_view(sphere_around(bounds), up);
  return (share > 0 ? "the scene fills " + percent_text(100 * share, 1) + " of the picture. It"
                    : "the camera sees nothing of the scene, which") +
         " lies between " + rounded_text(bounds.low) + " and " + rounded_text(bounds.high) +
         ": to see the whole scene use --camera=" + text_of(camera_of(view));
}

}  // namespace dmpc::apps
