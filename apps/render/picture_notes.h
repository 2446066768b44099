// Notes for users about a picture: saturated light, or a scene of which it shows nothing.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/formats/up_axis.h"
#include "core/base/box.h"
#include "core/picture/film/film.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// A sentence about clipped light, and one if the whole picture is so dark that the film's quantization shows; usually none.
/// `lit`: number of shadow rays that reached a light with a contribution: if it is not 0, a picture should not be black.
std::vector<std::string> film_notes(const core::Film& film, std::uint64_t lit);

/// The up axis of a scene as it is seen: the one nearest to its view's up.
UpAxis up_of(const core::View& view);

/// The share of a picture below which its scene is told to be small.
inline constexpr double small_share = 0.02;

/// A sentence for a picture of which the scene fills `share`, up to small_share: the scene's position, and the camera that shows
/// all of it. Requires bounds that are not empty.
std::string small_note(double share, const core::Box& bounds, const UpAxis& up);

}  // namespace dmpc::apps
