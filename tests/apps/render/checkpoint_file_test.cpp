#include "apps/render/checkpoint_file.h"

#include <doctest/doctest.h>

#include <string>

#include "core/base/expect.h"
#include "tests/support/complaint.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::apps::checkpoint_file_test {

using tests::contains;
using tests::file_text;
using tests::TemporaryFolder;
using tests::write_text;

namespace {

const PictureIdentity identity{100, 50, {{"depth", "5"}, {"objects", "#12"}, {film_scale_fact, "1"}}, {.samples = 4}};

/// A picture of 5,000 pixels, of which a third are done.
struct SmallPicture {
  SmallPicture() {
    for (std::uint32_t pixel = 0; pixel < 5000; pixel += 3) {
      core::PixelSums sums;
      sums.plane[pixel % 2].channel[pixel % 3] = pixel;
      film.deposit(pixel, sums);
      done.add(pixel);
    }
  }
  void write(const std::filesystem::path& path) const { write_checkpoint(path, identity, film, pass, done); }

  core::Film film{100, 50};
  core::Refinement pass{{}, 4, 100, 50};
  core::PixelMask done{5000};
};

std::string file_complaint(const std::filesystem::path& path, const PictureIdentity& of = identity) {
  return tests::complaint_of([&] { read_checkpoint(path, of); });
}

}  // namespace

TEST_CASE("what is read from a checkpoint is what was written") {
  const TemporaryFolder folder;
  const SmallPicture small;
  small.write(folder / "a");
  const core::PartialPicture read = read_checkpoint(folder / "a", identity);
  CHECK(read.film.hash() == small.film.hash());
  CHECK(read.film.samples() == 0);
  CHECK(read.passes == 1);
  CHECK(read.pass == small.pass.pass());
  CHECK(read.done == small.done);
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("a checkpoint replaces the one before, and a file that a killed process has left") {
  const TemporaryFolder folder;
  SmallPicture small;
  small.write(folder / "a");
  write_text(next_name(folder / "a"), "half");
  small.done.add(1);
  small.write(folder / "a");
  CHECK(read_checkpoint(folder / "a", identity).done == small.done);
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("a checkpoint of another picture is refused, with what differs") {
  const TemporaryFolder folder;
  SmallPicture().write(folder / "a");
  PictureIdentity other = identity;
  other.facts[0].value = "4";
  other.facts[1].value = "#13";
  CHECK(contains(file_complaint(folder / "a", other), "of another picture: depth is 5, here 4; other objects"));
}

TEST_CASE("wherever a byte of a checkpoint is changed, it is refused") {
  const TemporaryFolder folder;
  SmallPicture().write(folder / "a");
  const std::string text = file_text(folder / "a");
  for (std::size_t place = 0; place < text.size(); place += place < 80 ? 1 : 4999) {
    std::string changed = text;
    changed[place] = static_cast<char>(changed[place] ^ 1);
    write_text(folder / "b", changed);
    CAPTURE(place);
    CHECK_FALSE(file_complaint(folder / "b").empty());
  }
}

TEST_CASE("a checkpoint's film has the scale of the picture") {
  const TemporaryFolder folder;
  PictureIdentity scaled = identity;
  scaled.facts.back().value = "2^34";
  scaled.terms.film_scale = {34};
  const core::Film film(100, 50, {34});
  write_checkpoint(folder / "a", scaled, film, core::Refinement({}, 4, 100, 50), core::PixelMask(5000));
  CHECK(contains(file_text(folder / "a"), "film-scale=2^34\n"));
  CHECK(read_checkpoint(folder / "a", scaled).film.scale() == film.scale());
}

TEST_CASE("a checkpoint that is cut short or goes on too long is damaged") {
  const TemporaryFolder folder;
  SmallPicture().write(folder / "a");
  const std::string text = file_text(folder / "a");
  for (const std::string& wrong : {text.substr(0, text.size() - 1), text.substr(0, 1000), text + "x"}) {
    write_text(folder / "b", wrong);
    CHECK(contains(file_complaint(folder / "b"), "is damaged or cut short"));
  }
}

TEST_CASE("what is no checkpoint is refused") {
  const TemporaryFolder folder;
  write_text(folder / "a", "");
  CHECK(contains(file_complaint(folder / "a"), "no checkpoint"));
  write_text(folder / "a", "dmpc checkpoint 2\n\n");
  CHECK(contains(file_complaint(folder / "a"), "no checkpoint of this version of dmpc: its format is 2, here 4 is read"));
  CHECK(contains(file_complaint(folder / "none"), "cannot be read"));
  write_text(folder / "a", "dmpc checkpoint 4\n" + std::string(100'000, 'x') + "=\n");
  CHECK(contains(file_complaint(folder / "a"), "is damaged"));
  CHECK(contains(file_complaint("/dev/zero"), "no checkpoint"));
}

TEST_CASE("where there is no room for a checkpoint that is said") {
  CHECK_THROWS_WITH_AS(SmallPicture().write("/dev/full"), "--checkpoint /dev/full: cannot be written: No space left on device",
                       core::InputError);
}

TEST_CASE("what somebody else has put where the next checkpoint would be made keeps none from being written") {
  const SmallPicture small;
  const TemporaryFolder folder;
  small.write(folder / "a");
  std::filesystem::create_directory(next_name(folder / "a"));
  small.write(folder / "a");
  CHECK(read_checkpoint(folder / "a", identity).done == small.done);
}

}  // namespace dmpc::apps::checkpoint_file_test
