#include "core/picture/film/partial_picture.h"

#include <doctest/doctest.h>

#include <limits>
#include <string>
#include <vector>

namespace dmpc::core::partial_picture_test {

namespace {

constexpr int picture_width = 10, picture_height = 7;
constexpr std::uint32_t picture_pixels = 70;

/// Light as if each of so many samples on both planes had brought as much as film_resolution.
void bring(PartialPicture& picture, std::uint32_t pixel, std::int64_t first, std::int64_t second) {
  PixelSums sums;
  sums.plane[0].channel[1] = first;
  sums.plane[1].channel[2] = second;
  picture.film.deposit(pixel, sums);
}

PartialPicture with_samples(std::uint32_t samples) {
  return {Film(picture_width, picture_height), 1, Pass(picture_pixels, samples), PixelMask(picture_pixels),
          std::vector<PixelPast>(picture_pixels)};
}

/// Two samples a pixel, of which three have theirs.
PartialPicture in_first_pass() {
  PartialPicture picture = with_samples(2);
  for (const std::uint32_t pixel : {0U, 63U, 69U}) {
    picture.done.add(pixel);
    bring(picture, pixel, 1, 1);
  }
  return picture;
}

/// The second pass has doubled the samples of pixels 5 to 9, the third is about to double those of 7 again, and those of 8 twice,
/// which is done; so the light that those two had is gathered on the first plane, where the fourth sample fell.
PartialPicture in_third_pass() {
  PartialPicture picture = with_samples(2);
  picture.passes = 3;
  for (std::uint32_t pixel = 0; pixel < picture_pixels; ++pixel) {
    const bool is_refined = pixel >= 5 && pixel <= 9;
    picture.film.add_samples(pixel, is_refined ? 4 : 2);
    picture.pass.steps()[pixel] = is_refined ? SampleStep(2, 2) : SampleStep(1, 1);
    const bool is_gathered = pixel == 7 || pixel == 8;
    bring(picture, pixel, 1, is_gathered ? 0 : 1);
  }
  picture.pass.steps()[7] = {2, 3};
  picture.pass.steps()[8] = {2, 4};
  picture.done.add(8);
  return picture;
}

constexpr PictureTerms terms_of_two{2, {.error = 0.01, .samples_max = 20}, 1};

template <class Change>
std::string fault_after(PartialPicture picture, const Change& change, const PictureTerms& terms = terms_of_two) {
  change(picture);
  const char* const fault = fault_of(picture, terms);
  return fault == nullptr ? "" : fault;
}

constexpr auto unchanged = [](PartialPicture&) {};

}  // namespace

TEST_CASE("a picture that could have come about has no fault") {
  CHECK(fault_after(in_first_pass(), unchanged).empty());
  CHECK(fault_after(in_first_pass(), unchanged, {.samples = 2}).empty());
  CHECK(fault_after(in_third_pass(), unchanged).empty());
  CHECK(fault_after(in_first_pass(), [](auto& picture) { bring(picture, 0, std::numeric_limits<std::int64_t>::max(), 0); },
                    {.samples = 2})
            .empty());
}

TEST_CASE("a pass that the picture cannot have is a fault") {
  CHECK(fault_after(in_first_pass(), [](auto& picture) { picture.passes = 0; }) == "a pass that the picture does not have");
  CHECK(fault_after(in_third_pass(), [](auto& picture) { picture.passes = passes_max + 1; }) ==
        "a pass that the picture does not have");
  CHECK(fault_after(in_third_pass(), unchanged, {.samples = 2}) == "a pass that the picture does not have");
  CHECK(fault_after(in_first_pass(), [](auto& picture) { picture.pass.steps()[3] = {}; }) == "a first pass without all pixels");
  CHECK(fault_after(in_first_pass(), [](auto& picture) {
          picture.pass.steps()[3] = {0, 2};
        }) == "a first pass without all pixels");
  for (const SampleStep step : {SampleStep(1, 2), SampleStep(3, 4), SampleStep(2, 1), SampleStep(2, 5), SampleStep(2, 15)}) {
    CHECK(fault_after(in_third_pass(), [&](auto& picture) { picture.pass.steps()[7] = step; }) ==
          "a pass that goes on from other samples");
  }
  CHECK(fault_after(in_third_pass(),
                    [](auto& picture) {
                      picture.pass.steps()[6] = {2, 6};
                    },
                    {2, {.error = 1}}) == "a pass that goes on from other samples");  // more doublings than a pass may have
  const auto without_pixels = [](auto& picture) {
    picture.pass.steps()[7] = picture.pass.steps()[8] = {2, 2};
    picture.done = PixelMask(picture_pixels);
  };
  CHECK(fault_after(in_third_pass(), without_pixels) == "a pass without pixels");
}

TEST_CASE("pixels that are done beyond the picture or the pass are a fault") {
  CHECK(fault_after(in_first_pass(), [](auto& picture) { picture.done.words()[1] |= std::uint64_t{1} << 63; }) ==
        "a pixel beyond the picture");
  CHECK(fault_after(in_third_pass(), [](auto& picture) { picture.done.add(9); }) == "a pixel that is done, and not of the pass");
}

TEST_CASE("samples that the passes do not come to are a fault") {
  CHECK(fault_after(in_first_pass(), [](auto& picture) { picture.film.add_samples(3, 2); }) ==
        "samples of passes before the first");
  CHECK(fault_after(in_third_pass(), [](auto& picture) { picture.film.add_samples(3, 1); }) == "samples that no passes come to");
  CHECK(fault_after(in_third_pass(), [](auto& picture) { picture.film.add_samples(3, 30); }) == "samples that no passes come to");
  CHECK(fault_after(in_third_pass(), [](auto& picture) { picture.passes = 8; }) == "samples of fewer passes");
  CHECK(fault_after(in_third_pass(), [](auto& picture) { picture.passes = 2; }) == "samples that no passes come to");
}

TEST_CASE("what no film can have left in an estimate is a fault") {
  const std::string expected = "an estimate that no film has";
  const float infinite = std::numeric_limits<float>::infinity();
  CHECK(fault_after(in_third_pass(), [](auto& picture) { picture.past.clear(); }) == expected);
  for (const PixelPast& past :
       {PixelPast{.mean = {0, -1, 0}}, PixelPast{.mean = {0, 0, infinite}}, PixelPast{.expected = -2}, PixelPast{.expected = 1},
        PixelPast{.evidence = -infinite}, PixelPast{.weight = 1.5F}, PixelPast{.weight = -1}, PixelPast{.change = -1},
        PixelPast{.change = infinite}, PixelPast{.reported_change = -1}, PixelPast{.reported_quarter_change = infinite}}) {
    CHECK(fault_after(in_third_pass(), [&](auto& picture) { picture.past[50] = past; }) == expected);
  }
}

TEST_CASE("what is missing of a pass, and the samples that are done, count each pixel's own") {
  const PartialPicture picture = in_third_pass();
  CHECK(picture.missing().count() == 1);
  CHECK(picture.missing().has(7));
  CHECK(picture.samples_done() == picture.film.samples() + 12);
}

TEST_CASE("light without samples, below nothing or above what they can bring is a fault") {
  const std::string expected = "light that no samples have brought";
  CHECK(fault_after(in_first_pass(), [](auto& picture) { bring(picture, 1, 1, 0); }) == expected);
  CHECK(fault_after(in_first_pass(), [](auto& picture) { bring(picture, 0, -2, 0); }) == expected);
  const std::int64_t one = std::int64_t{1} << 32;
  CHECK(fault_after(in_first_pass(), [&](auto& picture) { bring(picture, 0, one, one); }).empty());
  CHECK(fault_after(in_first_pass(), [&](auto& picture) { bring(picture, 0, 0, 3 * one); }) == expected);
  CHECK(fault_after(in_third_pass(), [&](auto& picture) { bring(picture, 7, 9 * one, 0); }) == expected);
  CHECK(fault_after(in_third_pass(), [&](auto& picture) { bring(picture, 7, 0, 1); }) == expected);
  CHECK(fault_after(in_third_pass(), [&](auto& picture) { bring(picture, 8, 9 * one, 7 * one); }).empty());
  CHECK(fault_after(in_third_pass(), [&](auto& picture) { bring(picture, 8, 0, 9 * one); }) == expected);
  const PictureTerms terms_of_one{.samples = 1};
  const auto has_one = [](auto& picture) { picture.pass = Pass(picture_pixels, 1); };
  CHECK(fault_after(in_first_pass(), has_one, terms_of_one) == expected);  // there is no second sample
}

}  // namespace dmpc::core::partial_picture_test
