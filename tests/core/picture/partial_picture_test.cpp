#include "core/picture/partial_picture.h"

#include <doctest/doctest.h>

#include <limits>
#include <string>

namespace dmpc::core {

namespace {

constexpr int picture_width = 10, picture_height = 7;
constexpr std::uint32_t picture_pixels = 70;

/// Light as if each of `even` and `odd` samples had brought as much as film_resolution.
void bring(PartialPicture& picture, std::uint32_t pixel, std::int64_t even, std::int64_t odd) {
  PixelSums sums;
  sums.plane[0].channel[1] = even;
  sums.plane[1].channel[2] = odd;
  picture.film.deposit(pixel, sums);
}

/// Two samples a pixel, of which three have theirs.
PartialPicture in_first_pass() {
  PartialPicture picture{
      Film(picture_width, picture_height), 1, {0, 2}, PixelMask(picture_pixels, true), PixelMask(picture_pixels)};
  for (const std::uint32_t pixel : {0U, 63U, 69U}) {
    picture.done.add(pixel);
    bring(picture, pixel, 1, 1);
  }
  return picture;
}

/// The second pass has doubled the samples of pixels 5 to 9, the third is about to double those of 7 and 8 again; 8 is done.
PartialPicture in_third_pass() {
  PartialPicture picture{Film(picture_width, picture_height), 3, {4, 4}, PixelMask(picture_pixels), PixelMask(picture_pixels)};
  for (std::uint32_t pixel = 0; pixel < picture_pixels; ++pixel) {
    picture.film.add_samples(pixel, pixel >= 5 && pixel <= 9 ? 4 : 2);
    bring(picture, pixel, 1, 1);
  }
  picture.pixels.add(7);
  picture.pixels.add(8);
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
  CHECK(fault_after(in_third_pass(), unchanged, {.samples = 2}) == "a pass that the picture does not have");
  CHECK(fault_after(in_first_pass(), [](auto& picture) { picture.samples.count = 3; }) ==
        "a first pass with other samples than the picture's");
  CHECK(fault_after(in_first_pass(), [](auto& picture) { picture.samples.first = 1; }) ==
        "a first pass with other samples than the picture's");
  CHECK(fault_after(in_first_pass(), [](auto& picture) { picture.pixels.words()[0] ^= 4U; }) ==
        "a first pass without all pixels");
  for (const SampleRange& samples : {SampleRange{0, 0}, SampleRange{6, 6}, SampleRange{4, 2}, SampleRange{16, 16},
                                     SampleRange{std::uint32_t{1} << 31, std::uint32_t{1} << 31}}) {
    CHECK(fault_after(in_third_pass(), [&](auto& picture) { picture.samples = samples; }) ==
          "a pass that doubles no pixel's samples");
  }
  CHECK(fault_after(in_third_pass(), [](auto& picture) { picture.pixels = picture.done = PixelMask(picture_pixels); }) ==
        "a pass without pixels");
}

TEST_CASE("masks that do not fit the picture or each other are a fault") {
  CHECK(fault_after(in_first_pass(), [](auto& picture) { picture.pixels.words()[1] |= 1U << 6; }) ==
        "a pixel beyond the picture");
  CHECK(fault_after(in_first_pass(), [](auto& picture) { picture.done.words()[1] |= std::uint64_t{1} << 63; }) ==
        "a pixel beyond the picture");
  CHECK(fault_after(in_third_pass(), [](auto& picture) { picture.done.add(9); }) == "a pixel that is done, and not of the pass");
}

TEST_CASE("samples that the passes do not come to are a fault") {
  CHECK(fault_after(in_first_pass(), [](auto& picture) { picture.film.add_samples(3, 2); }) ==
        "samples of passes before the first");
  CHECK(fault_after(in_third_pass(), [](auto& picture) { picture.film.add_samples(3, 1); }) == "samples that no passes come to");
  CHECK(fault_after(in_third_pass(), [](auto& picture) { picture.film.add_samples(3, 30); }) == "samples that no passes come to");
  CHECK(fault_after(in_third_pass(), [](auto& picture) { picture.pixels.add(3); }) == "samples that no passes come to");
  CHECK(fault_after(in_third_pass(), [](auto& picture) { picture.passes = 8; }) == "samples of more or fewer passes");
  CHECK(fault_after(in_third_pass(), [](auto& picture) { picture.passes = 2; }) == "samples of more or fewer passes");
}

TEST_CASE("light without samples, below nothing or above what they can bring is a fault") {
  const std::string expected = "light that no samples have brought";
  CHECK(fault_after(in_first_pass(), [](auto& picture) { bring(picture, 1, 1, 0); }) == expected);
  CHECK(fault_after(in_first_pass(), [](auto& picture) { bring(picture, 0, -2, 0); }) == expected);
  const std::int64_t one = std::int64_t{1} << 32;
  CHECK(fault_after(in_first_pass(), [&](auto& picture) { bring(picture, 0, one, one); }).empty());
  CHECK(fault_after(in_first_pass(), [&](auto& picture) { bring(picture, 0, 0, 3 * one); }) == expected);
  CHECK(fault_after(in_third_pass(), [&](auto& picture) { bring(picture, 7, 5 * one, 0); }) == expected);
  CHECK(fault_after(in_third_pass(), [&](auto& picture) { bring(picture, 8, 5 * one, 0); }).empty());
  const PictureTerms terms_of_one{.samples = 1};
  const auto has_one = [](auto& picture) { picture.samples.count = 1; };
  CHECK(fault_after(in_first_pass(), has_one, terms_of_one) == expected);  // there is no second sample
}

}  // namespace dmpc::core
