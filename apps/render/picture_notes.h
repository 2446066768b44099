// What a user should know of a picture: light that its film could not hold, a scene of which it shows nothing.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/formats/up_axis.h"
#include "core/base/box.h"
#include "core/picture/film/film.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// A sentence for light that was cut, and one where the whole picture is so dark that the film's steps show; none, as a rule.
/// `lit`: shadow rays that reached a light with something to bring: what says of a black picture that it should not be black.
std::vector<std::string> film_notes(const core::Film& film, std::uint64_t lit);

/// The axis that points up as a scene is seen: the one nearest to its view's up.
UpAxis up_of(const core::View& view);

/// A sentence for a picture whose rays from the eye meet nothing: where the scene lies, and the camera that shows the whole of
/// it. Requires bounds that hold something.
std::string unseen_note(const core::Box& bounds, const UpAxis& up);

}  // namespace dmpc::apps
