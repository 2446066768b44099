#include "core/picture/partial_picture.h"

#include <algorithm>
#include <bit>
#include <optional>

namespace dmpc::core {

namespace {

/// How often the samples of the first pass can be doubled; 0 without refinement.
std::uint32_t level_max(const PictureTerms& terms) {
  std::uint32_t level = 0;
  while (terms.refinement.is_wanted() && std::uint64_t{terms.samples} << (level + 1) <= terms.refinement.samples_max) {
    ++level;
  }
  return level;
}

/// How often the picture's samples were doubled to make `samples`; nothing if they were not.
std::optional<std::uint32_t> level_of(std::uint32_t samples, const PictureTerms& terms) {
  if (samples < terms.samples || samples % terms.samples != 0 || !std::has_single_bit(samples / terms.samples)) {
    return std::nullopt;
  }
  const auto level = static_cast<std::uint32_t>(std::bit_width(samples / terms.samples) - 1);
  return level <= level_max(terms) ? std::optional(level) : std::nullopt;
}

bool is_beyond(const PixelMask& mask, std::uint32_t pixel_count) {
  return pixel_count % 64 != 0 && mask.words().back() >> (pixel_count % 64) != 0;
}

/// Twice what scenes can bring, for what is rounded on the way.
bool can_hold(const FixedColor& sum, std::uint32_t samples, const PictureTerms& terms) {
  const double most = 2 * terms.radiance_max * samples / film_resolution + samples;
  return std::all_of(sum.channel.begin(), sum.channel.end(),
                     [&](std::int64_t channel) { return channel == 0 || (channel > 0 && static_cast<double>(channel) <= most); });
}

const char* fault_of_masks(const PartialPicture& picture) {
  const auto pixel_count = static_cast<std::uint32_t>(picture.film.pixels().size());
  if (is_beyond(picture.pixels, pixel_count) || is_beyond(picture.done, pixel_count)) {
    return "a pixel beyond the picture";
  }
  if (picture.done.without(picture.pixels).count() > 0) {
    return "a pixel that is done, and not of the pass";
  }
  return nullptr;
}

const char* fault_of_first_pass(const PartialPicture& picture, const PictureTerms& terms) {
  if (picture.samples != SampleRange{0, terms.samples}) {
    return "a first pass with other samples than the picture's";
  }
  if (picture.pixels.count() != picture.film.pixels().size()) {
    return "a first pass without all pixels";
  }
  return picture.film.samples() > 0 ? "samples of passes before the first" : nullptr;
}

/// Each pass after the first doubles the samples of some pixels of one level.
const char* fault_of_later_pass(const PartialPicture& picture, const PictureTerms& terms) {
  const auto pass_level = level_of(picture.samples.count, terms);
  if (!pass_level || *pass_level >= level_max(terms) || picture.samples.first != picture.samples.count) {
    return "a pass that doubles no pixel's samples";
  }
  if (picture.pixels.count() == 0) {
    return "a pass without pixels";
  }
  std::uint64_t doublings = 0, doublings_of_one = 0;
  for (std::uint32_t pixel = 0; pixel < picture.film.pixels().size(); ++pixel) {
    const auto level = level_of(picture.film.samples(pixel), terms);
    if (!level || (picture.pixels.has(pixel) && *level != *pass_level)) {
      return "samples that no passes come to";
    }
    doublings += *level;
    doublings_of_one = std::max<std::uint64_t>(doublings_of_one, *level);
  }
  const std::uint64_t doubling_passes = picture.passes - 2;
  return doubling_passes < doublings_of_one || doubling_passes > doublings ? "samples of more or fewer passes" : nullptr;
}

const char* fault_of_light(const PartialPicture& picture, const PictureTerms& terms) {
  for (std::uint32_t pixel = 0; pixel < picture.film.pixels().size(); ++pixel) {
    const std::uint32_t samples = picture.film.samples(pixel) + (picture.done.has(pixel) ? picture.samples.count : 0);
    const auto& [even, odd] = picture.film.pixels()[pixel].plane;
    if (!can_hold(even, samples - samples / 2, terms) || !can_hold(odd, samples / 2, terms)) {
      return "light that no samples have brought";
    }
  }
  return nullptr;
}

}  // namespace

const char* fault_of(const PartialPicture& picture, const PictureTerms& terms) {
  if (const char* const fault = fault_of_masks(picture)) {
    return fault;
  }
  if (picture.passes == 0 || (picture.passes > 1 && !terms.refinement.is_wanted())) {
    return "a pass that the picture does not have";
  }
  const char* const fault = picture.passes == 1 ? fault_of_first_pass(picture, terms) : fault_of_later_pass(picture, terms);
  return fault != nullptr ? fault : fault_of_light(picture, terms);
}

}  // namespace dmpc::core
