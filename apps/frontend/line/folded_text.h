// Breaks long sentences into lines that fit a terminal and a page.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace dmpc::apps {

/// The words of `text` in lines of at most `width` letters, a longer word on a line of its own; lines after the first begin with
/// `indent`. Only the first line may begin with characters that Markdown takes for an item or a heading. Without a line end.
std::string folded(std::string_view text, std::size_t width, std::string_view indent);

}  // namespace dmpc::apps
