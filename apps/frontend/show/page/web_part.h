// Styles and scripts that are built into a page: the source files in this folder, unchanged.
#pragma once

#include <span>
#include <string>

namespace dmpc::apps::html {

/// A style or a script. CMake generates it from files (web_part() in apps/CMakeLists.txt).
struct WebPart {
  const char* text;
  const char* sha256;  ///< the text's digest: 64 hexadecimal digits
};

extern const WebPart page_style;   ///< page.css
extern const WebPart page_script;  ///< palette.js, plot.js and save.js

/// The content of the policy's meta element: it allows exactly these styles and scripts, by digest, pictures within the page, and
/// nothing else (W3C, "Content Security Policy Level 3").
std::string policy_of(std::span<const WebPart> styles, std::span<const WebPart> scripts);

}  // namespace dmpc::apps::html
