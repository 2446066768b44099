// Finds the known word that a user who typed another one probably meant.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace dmpc::core {

/// The number of insertions, deletions, replacements and swaps of neighbouring letters that turn one word into the other,
/// ignoring case (R. A. Wagner and R. Lowrance, "An Extension of the String-to-String Correction Problem", 1975, without editing
/// between swapped letters).
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The word of `words` nearest to `typed`: at most a third of its letters differ, or it is the only one that begins with `typed`.
/// The first of equally near ones; nothing if none is near.
std::optional<std::string> nearest_word(std::string_view typed, std::span<const std::string> words);

/// " Did you mean teapot?", to append to a message; empty if no word is near.
std::string did_you_mean(std::string_view typed, std::span<const std::string> words);

}  // namespace dmpc::core
