// What Assimp believes of a text in XML without a look: that arrays are as long as they say, that indices are whole numbers, that
// nothing is missing. It reads beyond its memory otherwise, or makes zeros of it.
#pragma once

#include <string>
#include <string_view>

namespace dmpc::apps {

/// Throws core::InputError, with the line, for an array of Collada that has another number of values than it says, an accessor
/// that looks beyond its array, a number of primitives or an index that is no whole number, and for a vertex or a triangle of AMF
/// that lacks one of its three. Other files, by `ending` (lower case), are not looked at.
void check_counts(std::string_view file, const std::string& ending);

}  // namespace dmpc::apps
