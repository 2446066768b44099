// What a reference is found by: a hash of everything that its bits depend on.
#pragma once

#include <string>

#include "apps/lab/oracle/accurate/reference.h"
#include "apps/scene/picture_options.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// To be counted up whenever the accurate renderer gives other bits for the same scene.
inline constexpr std::uint64_t reference_version = 2;

/// 32 hexadecimal digits: 128 bits, so that two references meet by chance never. The scene's name, the picture's samples and the
/// folder play no role.
std::string reference_key(const core::Scene& scene, const Resolution& resolution, const PictureOptions& picture,
                          const ReferenceOptions& options);

}  // namespace dmpc::apps
