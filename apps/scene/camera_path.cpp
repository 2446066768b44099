#include "apps/scene/camera_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "apps/formats/view_faults.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/parsed_number.h"
#include "apps/frontend/system/text_input.h"
#include "core/base/elementary.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

using core::Vec3d;
using core::View;

/// Lines of a path have a few hundred bytes at most.
constexpr std::size_t line_bytes_max = 4096;

/// Rotates about an axis of unit length (O. Rodrigues, 1840).
Vec3d turned_about(const Vec3d& axis, const Vec3d& v, double sine, double cosine) {
  return v * cosine + cross(axis, v) * sine + axis * (dot(axis, v) * (1 - cosine));
}

/// Weights of cubic Hermite interpolation at `u`, from 0 to 1: of both ends and their slopes.
struct Weights {
  double begin, begin_slope, end, end_slope;

  explicit Weights(double u)
      : begin((1 + 2 * u) * (1 - u) * (1 - u)),
        begin_slope(u * (1 - u) * (1 - u)),
        end(u * u * (3 - 2 * u)),
        end_slope(u * u * (u - 1)) {}
};

/// The two keyframes around a frame, and their neighbours; a missing neighbour is replaced by the keyframe itself.
struct Around {
  std::array<const Keyframe*, 4> keys;

  double span(std::size_t from, std::size_t to) const {
    return static_cast<double>(keys[to]->frame) - static_cast<double>(keys[from]->frame);
  }
  /// Interpolates `of(view)` at the frame.
  template <class Of>
  auto at(double u, const View& own, const Of& of) const {
    const auto value = [&](std::size_t i) { return of(view_at(keys[i]->camera, own)); };
    const Weights weight(u);
    const double span = this->span(1, 2);
    const auto begin_slope = (value(2) - value(0)) * (span / this->span(0, 2));
    const auto end_slope = (value(3) - value(1)) * (span / this->span(1, 3));
    return value(1) * weight.begin + begin_slope * weight.begin_slope + value(2) * weight.end + end_slope * weight.end_slope;
  }
};

[[noreturn]] void refuse(const std::string& place, const std::string& what) { throw core::InputError(place + ": " + what); }

Keyframe keyframe_in(const std::string& line, const std::string& place) {
  const std::size_t blank = line.find_first_of(" \t");
  const std::string_view word = std::string_view(line).substr(0, blank);
  const auto frame = number_in<std::uint64_t>(word);
  const std::size_t rest = line.find_first_not_of(" \t", blank);
  if (!frame || *frame < 1 || *frame > frame_max || rest == std::string::npos) {
    refuse(place, "\"" + line + "\": expected FRAME CAMERA such as 1 4,3,5/0,0,0/0,1,0/45, with a frame from 1 to " +
                      grouped(frame_max));
  }
  try {
    return {*frame, parse_camera(line.substr(rest), "the camera")};
  } catch (const core::UsageError& error) {
    refuse(place, error.what());
  }
}

/// Removes the comment and surrounding blanks.
std::string bare(std::string line) {
  line = line.substr(0, line.find('#'));
  constexpr const char* blanks = " \t\r\v\f";
  const std::size_t begin = line.find_first_not_of(blanks), end = line.find_last_not_of(blanks);
  return begin == std::string::npos ? std::string() : line.substr(begin, end + 1 - begin);
}

std::vector<Keyframe> keyframes_in(std::istream& input, const std::filesystem::path& file) {
  std::vector<Keyframe> keyframes;
  std::string line;
  for (std::uint64_t number = 1; std::getline(input, line); ++number) {
    const std::string place = file.string() + ":" + std::to_string(number);
    if (line.size() > line_bytes_max) {
      refuse(place, "this line has " + grouped(line.size()) + " bytes: expected FRAME CAMERA");
    }
    const std::string words = bare(line);
    if (words.empty()) {
      continue;
    }
    const Keyframe keyframe = keyframe_in(words, place);
    if (!keyframes.empty() && keyframe.frame <= keyframes.back().frame) {
      refuse(place, "frame " + grouped(keyframe.frame) + " does not follow frame " + grouped(keyframes.back().frame) +
                        ", the keyframe before it");
    }
    keyframes.push_back(keyframe);
  }
  if (keyframes.empty()) {
    refuse(file.string(), "expected a keyframe, a line such as 1 4,3,5/0,0,0/0,1,0/45");
  }
  return keyframes;
}

}  // namespace

CameraPath CameraPath::turntable(double degrees) {
  core::expect(std::abs(degrees) <= 360, "a turntable turns by a circle at most");
  CameraPath path;
  path.degrees_ = degrees;
  return path;
}

CameraPath::CameraPath(std::vector<Keyframe> keyframes) : keyframes_(std::move(keyframes)) {
  core::expect(!keyframes_.empty(), "a path has a keyframe");
}

Vec3d pivot_of(const View& view, const core::Box& bounds) {
  const Vec3d sight = view.at - view.from;
  const double along = bounds.empty() ? 0 : dot(bounds.center() - view.from, sight) / dot(sight, sight);
  return along > 0 ? view.from + sight * along : view.at;
}

void CameraPath::set_scene(const View& own, const core::Box& bounds) {
  own_ = own;
  pivot_ = pivot_of(own, bounds);
}

/// Rotates around the pivot.
View CameraPath::turned(std::uint64_t frame) const {
  View view = own_;
  // Exact: whole turns leave no remainder.
  const double degrees = std::fmod(degrees_ * static_cast<double>(frame - 1), 360);
  if (degrees != 0) {
    const double sine = core::sin_degrees(degrees), cosine = core::cos_degrees(degrees);
    for (Vec3d* const point : {&view.from, &view.at}) {
      *point = pivot_ + turned_about(normalize(own_.up), *point - pivot_, sine, cosine);
    }
  }
  return view;
}

View CameraPath::between(const Keyframe& key, const Keyframe& next, std::uint64_t frame) const {
  const Around around{
      {&key == keyframes_.data() ? &key : &key - 1, &key, &next, &next == &keyframes_.back() ? &next : &next + 1}};
  const double u = static_cast<double>(frame - key.frame) / static_cast<double>(next.frame - key.frame);
  View view = own_;
  view.from = around.at(u, own_, [](const View& at) { return at.from; });
  view.at = around.at(u, own_, [](const View& at) { return at.at; });
  view.up = around.at(u, own_, [](const View& at) { return at.up; });
  view.angle_degrees = around.at(u, own_, [](const View& at) { return at.angle_degrees; });
  return view;
}

View CameraPath::view(std::uint64_t frame) const {
  core::expect(frame >= first() && frame <= last(), "a view is asked for of a frame that there is");
  if (keyframes_.empty()) {
    return turned(frame);
  }
  const auto is_before = [](const Keyframe& key, std::uint64_t number) { return key.frame <= number; };
  const auto behind = std::lower_bound(keyframes_.begin(), keyframes_.end(), frame, is_before);
  const Keyframe& key = *(behind - 1);
  return key.frame == frame ? view_at(key.camera, own_) : between(key, *behind, frame);
}

void CameraPath::check(std::uint64_t first, std::uint64_t last) const {
  for (std::uint64_t frame = first; frame <= last && !keyframes_.empty(); ++frame) {
    if (fault_of(view(frame))) {
      throw core::InputError("--camera-path: frame " + grouped(frame) +
                             ": between its keyframes the camera shows nothing there, as it looks along its up, is at the point "
                             "that it looks at, or sees by an angle that is not between 0 and 180 degrees: set a keyframe there");
    }
  }
}

CameraPath read_camera_path(const std::filesystem::path& file) {
  try {
    TextInput input(file);
    return CameraPath(keyframes_in(input, file));
  } catch (const core::InputError& error) {
    throw core::InputError(std::string("--camera-path=") + error.what());
  }
}

}  // namespace dmpc::apps
