// A page in a real browser: headless Chromium, Debian's package chromium, which tests/run installs.
#pragma once

#include <doctest/doctest.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <string_view>

#include "tests/support/child_process.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests {

inline constexpr const char* chromium = "/usr/bin/chromium";

/// Tells how wide the page within is, how many of its pictures the browser shows, and what it has asked for. It stands outside,
/// as the page's policy has nothing run within that is not the page's own; hence --allow-file-access-from-files.
inline constexpr const char* telling_script =
    "<script>addEventListener('load',()=>{const frame=document.querySelector('iframe'),page=frame.contentDocument,"
    "window=frame.contentWindow,all=[...page.images];"
    "document.title=`width ${page.documentElement.scrollWidth} of ${window.innerWidth}, shown "
    "${all.filter(i=>i.complete&&i.naturalWidth>0).length} of ${all.length}, asked for "
    "${window.performance.getEntriesByType('resource').filter(e=>!e.name.startsWith('data:')).length}, tables cut "
    "${[...page.querySelectorAll('.scroll')].filter(e=>e.scrollWidth>e.clientWidth).length}, dark "
    "${window.matchMedia('(prefers-color-scheme:dark)').matches}`})</script>";

/// A window with a page so many pixels wide, since no window of the browser's is as narrow as a telephone. Its title says what
/// `script` has told of the page.
inline std::string window_around(const std::string& file, int width, const std::string& script) {
  return "<!DOCTYPE html><meta name=\"color-scheme\" content=\"light dark\">" + script +
         "<style>body{margin:0}iframe{border:0;height:900px;width:" + std::to_string(width) + "px}</style><iframe src=\"" + file +
         "\"></iframe>";
}

/// What the browser tells of the page in a window of so many pixels, of which it puts a picture into the file `shot`; empty if it
/// has not by that time of its own clock. `script` is an element that puts it into the window's title; `state` follows on the
/// page's address.
inline std::string reported_by_browser(const std::string& page, int width, bool is_dark, const std::filesystem::path& shot,
                                       const std::string& script = telling_script, const std::string& state = "",
                                       std::chrono::milliseconds time = std::chrono::milliseconds(5000)) {
  const TemporaryFolder folder;
  write_text(folder / "page.html", page);
  write_text(folder / "window.html", window_around("page.html" + state, width, script));
  ChildProcess browser({chromium, "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--no-first-run",
                        "--allow-file-access-from-files", "--user-data-dir=" + (folder / "profile").string(),
                        "--window-size=" + std::to_string(width) + ",900",
                        std::string("--blink-settings=preferredColorScheme=") + (is_dark ? "0" : "1"),
                        "--virtual-time-budget=" + std::to_string(time.count()), "--screenshot=" + shot.string(), "--dump-dom",
                        "file://" + (folder / "window.html").string()});
  const int status = browser.status();
  REQUIRE_MESSAGE(status == 0,
                  "chromium ends with status " << status << ": is the package chromium installed? " << browser.errors());
  const std::string dom = browser.output();
  constexpr std::string_view title = "<title>";
  const std::size_t begin = dom.find(title);
  return begin == std::string::npos ? "" : dom.substr(begin + title.size(), dom.find("</title>") - begin - title.size());
}

/// Nothing sticks out of a page of that width, all its pictures show, and it asked for nothing; on a screen no table is cut.
inline void check_shown_whole(const std::string& reported, const std::string& page, int width, bool is_dark) {
  INFO(reported);
  const std::string wide = std::to_string(width), pictures = std::to_string(count(page, "<img "));
  CHECK(contains(reported, "width " + wide + " of " + wide));
  CHECK(contains(reported, "shown " + pictures + " of " + pictures + ", asked for 0"));
  CHECK((width < 1280 || contains(reported, "tables cut 0,")));
  CHECK(contains(reported, is_dark ? "dark true" : "dark false"));
}

}  // namespace dmpc::tests
