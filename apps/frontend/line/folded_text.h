// Long sentences as lines that fit a terminal and a page.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace dmpc::apps {

/// The words of `text` in lines of at most `width` letters, a longer word on a line of its own; lines after the first begin with
/// `indent`. No line but the first begins with what Markdown takes for the mark of an item or a heading. Without a line end.
std::string folded(std::string_view text, std::size_t width, std::string_view indent);

}  // namespace dmpc::apps
