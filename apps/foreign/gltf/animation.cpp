#include "apps/foreign/gltf/animation.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <utility>

#include "apps/foreign/mesh/count_note.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/shown_text.h"
#include "core/base/elementary.h"
#include "core/base/expect.h"

namespace dmpc::apps::gltf {
namespace {

using Numbers = std::vector<double>;

enum class Interpolation : std::uint8_t { step, linear, cubic };

Interpolation interpolation_of(const Part& sampler) {
  const std::string text = sampler.choice("interpolation", {"STEP", "LINEAR", "CUBICSPLINE"}, "LINEAR");
  return text == "STEP" ? Interpolation::step : text == "LINEAR" ? Interpolation::linear : Interpolation::cubic;
}

Numbers weighted(const Numbers& a, double weight_of_a, const Numbers& b, double weight_of_b) {
  Numbers sum(a.size());
  for (std::size_t i = 0; i < sum.size(); ++i) {
    sum[i] = a[i] * weight_of_a + b[i] * weight_of_b;
  }
  return sum;
}

double dot(const Numbers& a, const Numbers& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    sum += a[i] * b[i];
  }
  return sum;
}

/// Normalizes a rotation; `where` reports one that has no direction.
Numbers unit(const Numbers& rotation, const Part& where) {
  const double length = std::sqrt(dot(rotation, rotation));
  if (!(length > 0 && std::isfinite(length))) {
    where.fail("a rotation is a quaternion of length " + rounded(length) + ", which turns nowhere");
  }
  return weighted(rotation, 1 / length, rotation, 0);
}

/// Keyframes, and what a node has at each of them.
class Sampler {
 public:
  Sampler(const Part& part, std::size_t width, Accessors& accessors)
      : input_(part.get("input")),
        output_(part.get("output")),
        interpolation_(interpolation_of(part)),
        times_(accessors.values(input_, 1)),
        values_(accessors.values(output_, width)) {
    check_times();
    check_values();
  }

  double end_seconds() const { return time(times_.count() - 1); }

  Numbers at(double seconds) const {
    const auto behind = std::upper_bound(times_.numbers.begin(), times_.numbers.end(), seconds,
                                         [](double moment, float time) { return moment < double{time}; });
    const auto next = static_cast<std::size_t>(behind - times_.numbers.begin());
    const std::size_t key = next == 0 ? 0 : next - 1;
    const bool is_at_key = next == 0 || next == times_.count() || interpolation_ == Interpolation::step;
    const Numbers found = is_at_key ? value(key) : between(key, (seconds - time(key)) / (time(next) - time(key)));
    return is_rotation() ? unit(found, output_) : found;
  }

 private:
  void check_times() const {
    if (times_.count() == 0) {
      input_.fail("has no keyframe, expected one at least");
    }
    for (std::size_t key = 0; key < times_.count(); ++key) {
      if (!(std::isfinite(time(key)) && time(key) >= 0 && (key == 0 || time(key) > time(key - 1)))) {
        input_.fail("keyframe " + grouped(key) + " is at " + rounded(time(key)) +
                    " seconds, expected times from 0 on of which each is behind the one before it");
      }
    }
  }

  void check_values() const {
    const std::uint64_t expected = std::uint64_t{times_.count()} * values_a_key();
    if (values_.count() != expected) {
      output_.fail("has " + counted(values_.count(), "value") + " for " + counted(times_.count(), "keyframe") + ", expected " +
                   grouped(expected));
    }
    if (!std::ranges::all_of(values_.numbers, [](float number) { return std::isfinite(number); })) {
      output_.fail("has a value that is not finite");
    }
  }

  double time(std::size_t key) const { return double{times_.numbers[key]}; }
  bool is_rotation() const { return values_.width == 4; }
  /// A keyframe of a spline has the slope before it, its value and the slope behind it.
  std::size_t values_a_key() const { return interpolation_ == Interpolation::cubic ? 3 : 1; }
  Numbers entry(std::size_t index) const {
    const auto numbers = values_[index];
    return {numbers.begin(), numbers.end()};
  }
  Numbers value(std::size_t key) const { return entry(key * values_a_key() + values_a_key() / 2); }

  Numbers between(std::size_t key, double u) const {
    if (interpolation_ == Interpolation::cubic) {
      return on_spline(key, u);
    }
    const Numbers from = value(key), to = value(key + 1);
    return is_rotation() ? on_arc(unit(from, output_), unit(to, output_), u) : weighted(from, 1 - u, to, u);
  }

  /// The shorter way round (K. Shoemake, "Animating Rotation with Quaternion Curves", 1985); straight where that is as good.
  Numbers on_arc(const Numbers& from, Numbers to, double u) const {
    constexpr double nearly_alike = 0.999999;
    double cosine = dot(from, to);
    if (cosine < 0) {
      to = weighted(to, -1, to, 0);
      cosine = -cosine;
    }
    if (cosine > nearly_alike) {
      return weighted(from, 1 - u, to, u);
    }
    const double sine = std::sqrt(1 - cosine * cosine), angle = core::angle_of(sine, cosine);
    return weighted(from, core::sin_radians((1 - u) * angle) / sine, to, core::sin_radians(u * angle) / sine);
  }

  /// Hermite's cubic, whose slopes are a second's.
  Numbers on_spline(std::size_t key, double u) const {
    const double span = time(key + 1) - time(key), left = 1 - u;
    const Numbers slope = entry(3 * key + 2), next_slope = entry(3 * key + 3);
    return weighted(weighted(value(key), (1 + 2 * u) * left * left, slope, span * u * left * left), 1,
                    weighted(value(key + 1), u * u * (3 - 2 * u), next_slope, span * u * u * (u - 1)), 1);
  }

  Part input_, output_;
  Interpolation interpolation_;
  Values times_, values_;
};

std::string name_of(const Part& animation) { return clipped(animation.text("name", animation.where())); }

std::string names_of(const std::vector<Part>& animations) {
  std::vector<std::string> names;
  std::transform(animations.begin(), animations.end(), std::back_inserter(names), name_of);
  return first_of(names, 20);
}

const Part& animation_called(const std::string& name, const std::vector<Part>& animations) {
  if (animations.empty()) {
    throw core::InputError("no animation is in it: leave out --animation, or take a file that has one");
  }
  const auto found =
      std::ranges::find_if(animations, [&](const Part& one) { return name.empty() || one.text("name", one.where()) == name; });
  if (found == animations.end()) {
    throw core::InputError("no animation in it is called " + clipped(name) + ", expected one of " + names_of(animations));
  }
  return *found;
}

/// Length of an animation as text after its name. Some last longer than frames can be counted.
std::string length_text(double seconds, double frames_per_second) {
  const double last = std::ceil(seconds * frames_per_second) + 1;
  return " takes " + rounded(seconds) + " seconds" +
         (last < 0x1p53 ? ": at " + rounded(frames_per_second) + " frames a second frame " +
                              grouped(static_cast<std::uint64_t>(last)) + " shows its end"
                        : "");
}

/// Puts together what the channels of one animation say.
class Player {
 public:
  Player(const Part& animation, const Document& document, Accessors& accessors)
      : samplers_(animation.list("samplers")), nodes_(document.root().list("nodes")), accessors_(accessors) {}

  /// One without a node moves nothing (3.11).
  void play(const Part& channel, double seconds) {
    const Part target = channel.get("target");
    const std::string path = target.get("path").as_text();
    if (path == "translation" || path == "rotation" || path == "scale") {
      if (target.find("node")) {
        move(channel, target, path, seconds);
      }
    } else {
      ++(path == "weights" ? weights : others);
    }
  }

  Pose pose;
  double end_seconds = 0;
  std::uint64_t weights = 0, others = 0;

 private:
  void move(const Part& channel, const Part& target, const std::string& path, double seconds) {
    const std::size_t node = target.required_index("node", nodes_.size(), "nodes");
    if (nodes_[node].find("matrix")) {
      target.fail("moves nodes[" + std::to_string(node) + "], which has a matrix, expected a translation, rotation and scale");
    }
    NodePose& of_node = pose[node];
    auto& moved = path == "translation" ? of_node.translation : path == "rotation" ? of_node.rotation : of_node.scale;
    if (moved) {
      target.fail("moves nodes[" + std::to_string(node) + "] by its " + path + ", which another channel does, too");
    }
    const std::size_t sampler = channel.required_index("sampler", samplers_.size(), "samplers");
    moved = played(sampler, path == "rotation" ? 4 : 3, seconds);
  }

  /// However many channels have it, it is decoded once.
  const Numbers& played(std::size_t sampler, std::size_t width, double seconds) {
    const auto [found, is_new] = played_.try_emplace({sampler, width});
    if (is_new) {
      const Sampler curve(samplers_[sampler], width, accessors_);
      found->second = curve.at(seconds);
      end_seconds = std::max(end_seconds, curve.end_seconds());
    }
    return found->second;
  }

  std::vector<Part> samplers_, nodes_;
  Accessors& accessors_;
  std::map<std::pair<std::size_t, std::size_t>, Numbers>
      played_;  ///< by sampler and width: of large ones the moment alone is kept
};

}  // namespace

Pose pose_at(const AnimationMoment& moment, const Document& document, Accessors& accessors, std::vector<std::string>& notes) {
  const std::vector<Part> animations = document.root().list("animations");
  const Part& animation = animation_called(moment.name, animations);
  Player player(animation, document, accessors);
  for (const Part& channel : animation.list("channels")) {
    player.play(channel, moment.seconds);
  }
  notes.push_back("animation " + name_of(animation) + length_text(player.end_seconds, moment.frames_per_second));
  note_count(notes, "channels of the animation that change morph weights, not played", player.weights);
  note_count(notes, "channels of the animation that change what extensions name, not played", player.others);
  return std::move(player.pose);
}

}  // namespace dmpc::apps::gltf
