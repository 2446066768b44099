// What a user should know of a picture whose light its film could not hold.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/picture/film.h"

namespace dmpc::apps {

/// A sentence for light that was cut, and one where the whole picture is so dark that the film's steps show; none, as a rule.
/// `lit`: shadow rays that reached a light with something to bring: what says of a black picture that it should not be black.
std::vector<std::string> film_notes(const core::Film& film, std::uint64_t lit);

}  // namespace dmpc::apps
