// Which of the words that there are somebody meant who typed another.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace dmpc::core {

/// How many letters must be put in, left out, replaced or swapped with their neighbours to make one word of the other; capital
/// and small letters are the same (R. A. Wagner and R. Lowrance, "An Extension of the String-to-String Correction Problem", 1975,
/// without editing between swapped letters).
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The word of `words` that is near `typed`: a third of its letters differ at most, or it begins so and no other does. Of equally
/// near ones the first; nothing if none is near.
std::optional<std::string> nearest_word(std::string_view typed, std::span<const std::string> words);

/// " Did you mean teapot?", to follow a sentence; empty if no word is near.
std::string did_you_mean(std::string_view typed, std::span<const std::string> words);

}  // namespace dmpc::core
