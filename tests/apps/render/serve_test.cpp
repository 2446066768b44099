// --serve by the program itself: what it says, what it shows, and that the picture is what it is without.
#include <doctest/doctest.h>

#include <csignal>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/served_page.h"
#include "tests/support/shell.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"
#include "tests/support/web_client.h"

namespace dmpc::tests::render_serve_test {

namespace {

/// A render that is served.
struct Served {
  explicit Served(const std::vector<std::string>& options, const std::string& scene = "balls-2")
      : page(line(options, scene, folder / "a.%d.png")) {}

  static std::vector<std::string> line(const std::vector<std::string>& options, const std::string& scene,
                                       const std::string& picture) {
    std::vector<std::string> words = {DMPC_PROGRAM, "render", scene, "--nodes=3", "--quiet", "--serve", "-o", picture};
    words.insert(words.end(), options.begin(), options.end());
    return words;
  }
  std::string got(const std::string& place) const { return page.got(place); }

  TemporaryFolder folder;
  ServedPage page;
};

/// A picture that takes longer than a test.
const std::vector<std::string> endless = {"--resolution=2048x2048", "--samples=64"};

}  // namespace

TEST_CASE("the address is said in one line, and the picture is what it is without, whoever looked on") {
  const TemporaryFolder folder;
  REQUIRE(run({DMPC_PROGRAM, "render", "balls-2", "--nodes=3", "--quiet", "--resolution=64x64", "-o", folder / "a.png"}).status ==
          0);
  Served nobody({"--resolution=64x64"});
  CHECK(nobody.page.process.status() == 0);
  CHECK(nobody.page.process.errors() == "dmpc: to be seen at " + nobody.page.address + "\n");
  CHECK(nobody.page.process.output().empty());
  CHECK(file_text(nobody.folder / "a.%d.png") == file_text(folder / "a.png"));
  Served looked_at({"--resolution=64x64", "--samples=64"});
  const std::string events = looked_at.got("events");
  CHECK(looked_at.page.process.status() == 0);
  CHECK(contains(events, "event: head\ndata: {\"frame\":0,\"height\":64"));
  CHECK(contains(events, "event: tile"));
  CHECK(contains(events, "event: end\ndata: {\"figures\":\"scene    balls-2"));
  CHECK(contains(events, "\"page\":false,\"said\":\"The picture is done.\"}"));
}

TEST_CASE("forty look on, of whom ten take nothing and ten go away: the picture is what it is without, and the rest hear of it") {
  const TemporaryFolder folder;
  const std::vector<std::string> size = {"--resolution=128x128", "--samples=64"};
  REQUIRE(run({DMPC_PROGRAM, "render", "balls-2", "--quiet", size[0], size[1], "-o", folder / "a.png"}).status == 0);
  Served served(size);
  std::vector<std::unique_ptr<WebClient>> viewers;
  for (int i = 0; i < 40; ++i) {
    viewers.push_back(std::make_unique<WebClient>(served.page.port));
    viewers.back()->get(served.page.path("events"), served.page.host);
  }
  std::vector<std::jthread> hearing;
  for (std::size_t i = 20; i < viewers.size(); ++i) {
    hearing.emplace_back([&viewer = *viewers[i]] { viewer.heard_all(); });
  }
  for (std::size_t i = 0; i < 10; ++i) {
    viewers[i]->heard_until("event: head");
    viewers[i].reset();
  }
  hearing.clear();
  for (std::size_t i = 20; i < viewers.size(); ++i) {
    const std::string& heard = viewers[i]->heard();  // nothing where all was over when he came
    CHECK_MESSAGE((heard.empty() || contains(heard, "\"said\":\"The picture is done.\"}")), heard.substr(0, 300));
  }
  CHECK_MESSAGE(contains(viewers[20]->heard(), "event: tile"), viewers[20]->heard().substr(0, 600));
  CHECK(served.page.process.status() == 0);
  CHECK(file_text(served.folder / "a.%d.png") == file_text(folder / "a.png"));
}

TEST_CASE("with --report who looks on has that page in the end") {
  const TemporaryFolder folder;
  Served served({"--resolution=64x64", "--samples=64", "--report=" + (folder / "a.html").string()});
  const std::string events = served.got("events");
  const std::string page = served.got("");
  CHECK(served.page.process.status() == 0);
  CHECK(contains(events, "\"page\":true,\"said\":\"The picture is done.\"}"));
  for (const std::string& one : {page, file_text(folder / "a.html")}) {
    CHECK(contains(one, "<h1>Render of balls-2</h1>"));
  }
}

TEST_CASE("who looks on when a signal ends the run is told so, and what it means") {
  Served served(endless);
  WebClient viewer(served.page.port);
  viewer.get(served.page.path("events"), served.page.host);
  viewer.heard_until("Rendering the picture.");
  served.page.process.send(SIGTERM);
  CHECK(
      contains(viewer.heard_all(),
               "event: end\ndata: {\"figures\":\"\",\"page\":false,\"said\":\"The run was interrupted: nothing was written.\"}"));
  CHECK(served.page.process.status() == 130);
}

TEST_CASE("who looks on may stop the run, as a signal does, and nobody who has not the address") {
  Served served(endless);
  WebClient viewer(served.page.port);
  viewer.get(served.page.path("events"), served.page.host);
  viewer.heard_until("Rendering the picture.");
  CHECK(contains(served.page.sent("stop", "{}", "Origin: http://evil.example\r\n"), "403 Forbidden"));
  CHECK(contains(served.page.got("stop"), "404 Not Found"));
  CHECK(contains(served.page.sent("go", "{}"), "405 Method Not Allowed"));
  CHECK(contains(served.page.sent("stop", "{}"), "200 OK"));
  CHECK(contains(viewer.heard_all(), "\"said\":\"The run was interrupted: nothing was written.\"}"));
  CHECK(served.page.process.status() == 130);
}

TEST_CASE("a stop that is asked for again, or beside a signal, ends nothing at once: the checkpoint stays") {
  for (const bool has_signal : {false, true}) {
    CAPTURE(has_signal);
    const TemporaryFolder folder;
    Served served({endless[0], endless[1], "--checkpoint=" + (folder / "a.ck").string()});
    WebClient viewer(served.page.port);
    viewer.get(served.page.path("events"), served.page.host);
    viewer.heard_until("Rendering the picture.");
    viewer.heard_until("event: tile");
    has_signal ? served.page.process.send(SIGINT) : static_cast<void>(served.page.sent("stop", "{}"));
    for (int i = 0; i < 3; ++i) {
      served.page.sent("stop", "{}");
    }
    viewer.heard_all();
    CHECK(served.page.process.status() == 130);
    CHECK(std::filesystem::exists(folder / "a.ck"));
  }
}

TEST_CASE("who looks on when the run fails is told why") {
  Served served({"--resolution=8x8", "--node-memory=1KiB"}, "mount-6");
  const std::string events = served.got("events");
  CHECK(served.page.process.status() == 4);
  CHECK(contains(events, "event: end\ndata: {\"figures\":\"\",\"page\":false,\"said\":\"The run has failed: "));
}

TEST_CASE("of several frames the one under way is shown, and no page follows the last") {
  Served served({"--frames=3", "--turntable=10", "--resolution=32x32", "--samples=64"});
  const std::string events = served.got("events");
  CHECK(served.page.process.status() == 0);
  CHECK(contains(events, "\"frame\":3"));
  CHECK(contains(events, "event: end\ndata: {\"figures\":\"frame 1  "));
  CHECK(contains(events, "\"page\":false,\"said\":\"All frames are done.\"}"));
}

TEST_CASE("a frame that is a copy leaves the picture shown, and is in the lines at the end") {
  Served served({"--frames=2", "--turntable=0", "--resolution=32x32", "--samples=64"});
  const std::string events = served.got("events");
  CHECK(served.page.process.status() == 0);
  CHECK(contains(events, "\"frame\":1"));
  CHECK_FALSE(contains(events, "\"frame\":2"));
  CHECK(contains(events, ", a copy of frame 1\\n"));
  CHECK(contains(events, "\"said\":\"All frames are done.\"}"));
}

TEST_CASE("a port that is none, or has somebody, and the viewer that was before, are said before anything is read") {
  const TemporaryFolder folder;
  const auto said = [&](const std::string& option) {
    return run({DMPC_PROGRAM, "render", "none.nff", option, "-o", folder / "a.png"});
  };
  for (const std::string port : {"65536", "-1", "web", "127.0.0.1:80"}) {
    const Said wrong = said("--serve=" + port);
    CHECK(wrong.status == 2);
    CHECK_MESSAGE(contains(wrong.errors, "--serve=" + port + ": expected a port from 0 (any that is free) to 65,535"),
                  wrong.errors);
  }
  const Said bundles =
      run({DMPC_PROGRAM, "render", "tetra-1", "--runner=virtual", "--bundles", "--serve=0", "-o", folder / "a.png"});
  CHECK(bundles.status == 2);
  CHECK_MESSAGE(bundles.errors.starts_with("dmpc: --bundles does not go with --serve"), bundles.errors);
  const Served served(endless);
  const Said taken = said("--serve=" + std::to_string(served.page.port));
  CHECK(taken.status == 1);
  CHECK_MESSAGE(contains(taken.errors, "this port of 127.0.0.1 cannot be opened: Address already in use; give another"),
                taken.errors);
  const Said before = said("--preview");
  CHECK(before.status == 2);
  CHECK_MESSAGE(contains(before.errors, "--serve"), before.errors);
}

}  // namespace dmpc::tests::render_serve_test
