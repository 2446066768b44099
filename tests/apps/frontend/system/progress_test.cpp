#include "apps/frontend/system/progress.h"

#include <doctest/doctest.h>

#include <sstream>
#include <string>

namespace dmpc::apps::progress_test {

TEST_CASE("a progress line at the start knows no speed yet") {
  CHECK(progress_line(0, 100, 0) == "  0 % [>                             ]");
  CHECK(progress_line(0, 100, 5) == "  0 % [>                             ]");
}

TEST_CASE("a progress line says percent, speed and the time left") {
  CHECK(progress_line(500, 1000, 10) == " 50 % [===============>              ]       50 pixels/s, 0:10 left");
  CHECK(progress_line(1000, 1000, 1) == "100 % [==============================]     1000 pixels/s, 0:00 left");
}

TEST_CASE("a progress line does not say a time left that it cannot know yet") {
  CHECK(progress_line(500, 1000, 0.5) == " 50 % [===============>              ]     1000 pixels/s");
  CHECK(progress_line(9, 1000, 9).find("left") == std::string::npos);
  CHECK(progress_line(9, 1000, 10).find("left") != std::string::npos);
  CHECK(progress_line(10, 1000, 1).find("left") != std::string::npos);
}

TEST_CASE("a long time left is said in hours") {
  CHECK(progress_line(10, 37240, 10).find("10:20:30 left") != std::string::npos);
  CHECK(progress_line(1, std::uint64_t{1} << 40U, 1e9).find(" left") != std::string::npos);
}

TEST_CASE("progress that is not shown writes nothing") {
  std::ostringstream output;
  {
    Progress progress(output, false);
    progress.update(1, 2);
  }
  CHECK(output.str().empty());
}

TEST_CASE("shown progress rewrites one line and takes it away in the end") {
  std::ostringstream output;
  {
    Progress progress(output, true);
    progress.update(1, 2);
    progress.update(2, 2);  // too soon to be shown
  }
  const std::string text = output.str();
  CHECK(text.find('\n') == std::string::npos);
  CHECK(text.find(" 50 %") != std::string::npos);
  CHECK(text.find("100 %") == std::string::npos);
  CHECK(text.substr(text.size() - 4) == "\r\x1b[K");
}

TEST_CASE("a label is shown at once and stays before the line") {
  std::ostringstream output;
  Progress progress(output, true, "8 nodes: ");
  CHECK(output.str() == "\r\x1b[K8 nodes: ");
  progress.update(1, 2);
  CHECK(output.str().find("8 nodes:  50 %") != std::string::npos);
}

TEST_CASE("a label that is not shown is not written") {
  std::ostringstream output;
  Progress(output, false, "8 nodes: ").update(1, 2);
  CHECK(output.str().empty());
}

}  // namespace dmpc::apps::progress_test
