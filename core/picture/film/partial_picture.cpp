#include "core/picture/film/partial_picture.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

namespace dmpc::core {

namespace {

/// A pixel's level before the pass, from its samples; nothing if no sequence of passes leads to them.
std::optional<std::uint32_t> level_of(std::uint32_t samples, const PictureTerms& terms) {
  if (samples < terms.samples || samples % terms.samples != 0 || !std::has_single_bit(samples / terms.samples)) {
    return std::nullopt;
  }
  const auto level = static_cast<std::uint32_t>(std::bit_width(samples / terms.samples));
  return level <= level_max(terms.refinement, terms.samples) ? std::optional(level) : std::nullopt;
}

bool is_beyond(const PixelMask& mask, std::uint32_t pixel_count) {
  return pixel_count % 64 != 0 && mask.words().back() >> (pixel_count % 64) != 0;
}

/// Twice the maximum light of a scene, which allows for intermediate rounding.
bool can_hold(const FixedColor& sum, std::uint32_t samples, const PictureTerms& terms) {
  const double most = 2 * terms.radiance_max * samples * terms.film_scale.factor() / film_resolution + samples;
  return std::all_of(sum.channel.begin(), sum.channel.end(),
                     [&](std::int64_t channel) { return channel == 0 || (channel > 0 && static_cast<double>(channel) <= most); });
}

const char* fault_of_done(const PartialPicture& picture) {
  const auto pixel_count = static_cast<std::uint32_t>(picture.film.pixel_count());
  if (is_beyond(picture.done, pixel_count)) {
    return "a pixel beyond the picture";
  }
  for (std::uint32_t pixel = 0; pixel < pixel_count; ++pixel) {
    if (picture.done.has(pixel) && !picture.pass.has(pixel)) {
      return "a pixel that is done, and not of the pass";
    }
  }
  return nullptr;
}

const char* fault_of_first_pass(const PartialPicture& picture) {
  const auto steps = picture.pass.steps();
  if (!std::all_of(steps.begin(), steps.end(), [](const SampleStep& step) { return step == SampleStep::first(); })) {
    return "a first pass without all pixels";
  }
  return picture.film.samples() > 0 ? "samples of passes before the first" : nullptr;
}

/// Each pass after the first doubles the samples of some pixels, a few times at most.
const char* fault_of_later_pass(const PartialPicture& picture, const PictureTerms& terms) {
  if (picture.pass.pixel_count() == 0) {
    return "a pass without pixels";
  }
  const std::uint32_t passes_doubling = picture.passes - 2;  // completed ones
  std::uint64_t doublings = 0;
  for (std::uint32_t pixel = 0; pixel < picture.film.pixel_count(); ++pixel) {
    const auto level = level_of(picture.film.samples(pixel), terms);
    const SampleStep step = picture.pass.steps()[pixel];
    if (!level || *level - 1 > passes_doubling * doublings_max) {
      return "samples that no passes come to";
    }
    if (step.from() != *level || step.to() < *level || step.to() > *level + doublings_max ||
        step.to() > level_max(terms.refinement, terms.samples)) {
      return "a pass that goes on from other samples";
    }
    doublings += *level - 1;
  }
  return passes_doubling > doublings ? "samples of fewer passes" : nullptr;
}

/// More than any film can show, but without overflow. Only pixels that looked even have an expected error.
bool can_be(const PixelPast& past, const PictureTerms& terms) {
  const double error = terms.refinement.error * terms.film_scale.factor();
  constexpr float mean_max = 0x1p31F, evidence_max = 1e30F;
  const auto is_mean = [](float channel) { return channel >= 0 && channel <= mean_max; };
  const auto is_change = [](float change) { return change >= 0 && change <= evidence_max; };
  return std::all_of(past.mean.begin(), past.mean.end(), is_mean) && past.expected >= -1 &&
         double{past.expected} <= error * error && std::fabs(past.evidence) <= evidence_max && past.weight >= 0 &&
         past.weight <= 1 && is_change(past.change) && is_change(past.reported_change) && is_change(past.reported_quarter_change);
}

const char* fault_of_past(const PartialPicture& picture, const PictureTerms& terms) {
  const bool is_whole = picture.past.size() == picture.film.pixel_count();
  const auto is_right = [&](const PixelPast& past) { return can_be(past, terms); };
  return is_whole && std::all_of(picture.past.begin(), picture.past.end(), is_right) ? nullptr : "an estimate that no film has";
}

/// The maximum number of samples whose light a plane of a pixel can have. For a pixel that is not in this pass but was in an
/// earlier one, it is unknown when its planes were gathered.
std::uint32_t samples_on(std::uint32_t plane, const PartialPicture& picture, std::uint32_t pixel) {
  const std::uint32_t before = picture.film.samples(pixel);
  const std::uint32_t brought = picture.done.has(pixel) ? picture.pass.samples(pixel).count : 0;
  if (before == 0) {
    return core::samples_on(plane, brought);
  }
  const std::uint32_t next_block = std::min(brought, before), all = before + brought;
  return !picture.pass.has(pixel) ? all : plane == plane_of(before - 1) ? all - next_block : next_block;
}

const char* fault_of_light(const PartialPicture& picture, const PictureTerms& terms) {
  for (std::uint32_t pixel = 0; pixel < picture.film.pixel_count(); ++pixel) {
    for (const std::uint32_t plane : {0U, 1U}) {
      if (!can_hold(picture.film.sums(pixel).plane[plane], samples_on(plane, picture, pixel), terms)) {
        return "light that no samples have brought";
      }
    }
  }
  return nullptr;
}

}  // namespace

PixelMask PartialPicture::missing() const {
  PixelMask missing(static_cast<std::uint32_t>(film.pixel_count()));
  for (std::uint32_t pixel = 0; pixel < film.pixel_count(); ++pixel) {
    if (pass.has(pixel) && !done.has(pixel)) {
      missing.add(pixel);
    }
  }
  return missing;
}

std::uint64_t PartialPicture::samples_done() const {
  std::uint64_t sum = film.samples();
  for (std::uint32_t pixel = 0; pixel < film.pixel_count(); ++pixel) {
    sum += done.has(pixel) ? pass.samples(pixel).count : 0;
  }
  return sum;
}

PartialPicture partial_picture(const Film& film, const Refinement& refinement, const PixelMask& done) {
  return {film, refinement.result().passes, refinement.pass(), done, {refinement.past().begin(), refinement.past().end()}};
}

const char* fault_of(const PartialPicture& picture, const PictureTerms& terms) {
  if (picture.film.scale() != terms.film_scale) {
    return "light of another scale";
  }
  if (picture.passes == 0 || picture.passes > passes_max || (picture.passes > 1 && !terms.refinement.is_wanted())) {
    return "a pass that the picture does not have";
  }
  if (const char* const fault = fault_of_done(picture)) {
    return fault;
  }
  const char* fault = picture.passes == 1 ? fault_of_first_pass(picture) : fault_of_later_pass(picture, terms);
  if (fault == nullptr && terms.refinement.is_wanted()) {
    fault = fault_of_past(picture, terms);
  }
  return fault != nullptr ? fault : fault_of_light(picture, terms);
}

}  // namespace dmpc::core
