#include "apps/render/preview.h"
#include "apps/picture/film_image.h"

#include <doctest/doctest.h>

#include <chrono>
#include <new>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/child_process.h"
#include "tests/support/loopback_viewer.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::apps::preview_test {

using tests::LoopbackListener;
using tests::ShownPicture;
using tests::whole_packets;

namespace {

/// A film of 100x70 pixels, tile by tile 64x64 at most, on which pixels get the light of their numbers.
struct SmallFilm {
  void light(std::uint32_t pixel) {
    core::PixelSums sums;
    sums.plane[0] = core::to_fixed({static_cast<float>(pixel), 1, 0});
    film.deposit(pixel, sums);
  }
  float value(const ShownPicture& shown, std::uint32_t pixel) const { return shown.rgb[std::size_t{3} * pixel]; }

  core::Film film{100, 70};
  core::Refinement pass{{}, 1, 100, 70};
};

/// Lights all pixels one after the other, for as long as it takes for some to be sent.
void light_all(SmallFilm& small, Preview& preview) {
  for (std::uint32_t pixel = 0; pixel < 7000; ++pixel) {
    small.light(pixel);
    preview.watch(small.film, small.pass, pixel);
  }
}

}  // namespace

TEST_CASE("without a viewer there is no preview") {
  std::string port;
  {
    const LoopbackListener gone(false);
    port = gone.port();
  }
  CHECK(Preview::to_viewer({"127.0.0.1", port}, "a", 4, 4) == nullptr);
}

TEST_CASE("a viewer sees the picture in the end, tile by tile") {
  LoopbackListener listener;
  SmallFilm small;
  {
    const auto preview = Preview::to_viewer({"127.0.0.1", listener.port()}, "a picture", 100, 70);
    REQUIRE(preview != nullptr);
    light_all(small, *preview);
    small.pass.next_pass(small.film);
    preview->finish(small.film);
  }
  const ShownPicture shown(listener.received());
  CHECK(shown.name == "a picture");
  CHECK(shown.width == 100);
  CHECK(shown.height == 70);
  CHECK(shown.rgb == image_of(small.film).rgb);
  CHECK(shown.packets >= 1 + 4);
}

TEST_CASE("a viewer sees pixels as they come, with the light of the samples that they have") {
  LoopbackListener listener;
  SmallFilm small;
  {
    const auto preview = Preview::to_viewer({"127.0.0.1", listener.port()}, "a", 100, 70);
    REQUIRE(preview != nullptr);
    for (std::uint32_t pixel = 0; pixel < 64; ++pixel) {  // the first look
      small.light(pixel);
      preview->watch(small.film, small.pass, pixel);
    }
  }
  const ShownPicture shown(listener.received());
  CHECK(shown.packets == 1 + 1);
  CHECK(small.value(shown, 63) == 63);
  CHECK(small.value(shown, 163) == 0);
}

TEST_CASE("what goes wrong while tiles are sent ends the preview, and nothing else") {
  LoopbackListener listener;
  SmallFilm small;
  {
    const auto preview =
        Preview::to_viewer({"127.0.0.1", listener.port()}, "a", 100, 70, nullptr, {},
                           [](const std::string&, const PictureTile&) -> std::string { throw std::bad_alloc(); });
    REQUIRE(preview != nullptr);
    light_all(small, *preview);
    preview->finish(small.film);
  }
  CHECK(ShownPicture(listener.received()).packets == 1);
}

TEST_CASE("every tile has its turn, however many change all the time") {
  LoopbackListener listener;
  core::Film film(6400, 64);
  core::PixelSums light;
  light.plane[0] = core::to_fixed({1, 1, 1});
  film.deposit(6399, light);
  const core::Refinement pass({}, 1, 6400, 64);
  {
    const auto preview = Preview::to_viewer({"127.0.0.1", listener.port()}, "a", 6400, 64);
    REQUIRE(preview != nullptr);
    for (int rounds = 0; rounds < 10; ++rounds) {
      for (std::uint32_t tile = 0; tile < 80; ++tile) {  // more than are handed over at a time
        preview->watch(film, pass, 64 * tile);
      }
      preview->watch(film, pass, 6399);
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  }
  const ShownPicture shown(whole_packets(listener.received()));  // the preview was not finished
  CHECK(shown.rgb[std::size_t{3} * 6399] == 1);
}

TEST_CASE("in the end a viewer that takes nothing is not waited for when a stop is requested") {
  const LoopbackListener listener(false);
  const core::Film film(2048, 2048);
  std::stop_source stop;
  const auto preview = Preview::to_viewer({"127.0.0.1", listener.port()}, "a", 2048, 2048, nullptr, stop.get_token());
  REQUIRE(preview != nullptr);
  stop.request_stop();
  const auto begin = std::chrono::steady_clock::now();
  preview->finish(film);
  CHECK(std::chrono::steady_clock::now() - begin < std::chrono::milliseconds(300));
}

TEST_CASE("what was done before is shown, too") {
  LoopbackListener listener;
  SmallFilm small;
  core::PartialPicture start{core::Film(100, 70), 1, core::Pass(7000, 1), core::PixelMask(7000)};
  small.light(5);
  start.done.add(5);
  {
    const auto preview = Preview::to_viewer({"127.0.0.1", listener.port()}, "a", 100, 70, &start);
    REQUIRE(preview != nullptr);
    for (std::uint32_t pixel = 4500; pixel < 4564; ++pixel) {
      preview->watch(small.film, small.pass, pixel);
    }
  }
  const ShownPicture shown(listener.received());
  CHECK(shown.packets == 1 + 4);
  CHECK(small.value(shown, 5) == 5);
}

TEST_CASE("the host does not wait for a viewer that takes nothing") {
  const LoopbackListener listener(false);
  core::Film film(2048, 512);
  const core::Refinement pass({}, 1, 2048, 512);
  const auto preview = Preview::to_viewer({"127.0.0.1", listener.port()}, "a", 2048, 512);
  REQUIRE(preview != nullptr);
  const auto begin = std::chrono::steady_clock::now();
  for (int round = 0; round < 3; ++round) {
    for (std::uint32_t pixel = 0; pixel < film.pixel_count(); ++pixel) {
      preview->watch(film, pass, pixel);
    }
  }
  CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(20));
}

TEST_CASE("render shows its picture to a viewer, with every strategy, and in the end the one that it writes") {
  for (const std::string strategy : {"svm", "dataflow"}) {
    const tests::TemporaryFolder folder;
    LoopbackListener listener;
    tests::ChildProcess process({DMPC_PROGRAM, "render", "balls-2", "--resolution=80x70", "--nodes=2", "--strategy=" + strategy,
                                 "--preview=127.0.0.1:" + listener.port(), "-o", folder / "a.exr"});
    CHECK(process.status() == 0);
    const ShownPicture shown(listener.received());
    CHECK(shown.name == "balls-2");
    CHECK(shown.rgb == read_image(folder / "a.exr").rgb);
  }
}

}  // namespace dmpc::apps::preview_test
