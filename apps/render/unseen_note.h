// What a user should know of a picture that shows nothing of its scene.
#pragma once

#include <string>

#include "apps/formats/up_axis.h"
#include "core/base/box.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// The axis that points up as a scene is seen: the one nearest to its view's up.
UpAxis up_of(const core::View& view);

/// A sentence for a picture whose rays from the eye meet nothing: where the scene lies, and the camera that shows the whole of
/// it. Requires bounds that hold something.
std::string unseen_note(const core::Box& bounds, const UpAxis& up);

}  // namespace dmpc::apps
