#include "nodes/pictures/host.h"

#include <algorithm>
#include <utility>

#include "core/base/expect.h"
#include "core/base/units.h"
#include "core/picture/memory_use.h"

namespace dmpc::pictures {

nodes::Room<std::uint64_t> Host::own_layout(std::size_t pixel_count) {
  return {core::MemoryUse::film_tiles, core::ceil_divide<std::size_t>(pixel_count, 64)};
}

Host::Host(nodes::Node& node, core::Film& film, const core::RefinementOptions& wanted, std::uint32_t samples,
           nodes::Progress progress, const core::Continuation& continuation, const core::FineDetail* detail)
    : node_(&node),
      film_(&film),
      progress_(std::move(progress)),
      continuation_(continuation),
      wanted_(wanted),
      first_samples_(samples),
      refinement_(wanted, samples, film.width(), film.height(), detail, film.scale()),
      with_light_(own_layout(film.pixel_count()).in(node.memory())) {
  if (const core::PartialPicture* const start = continuation.start) {
    refinement_.resume(*start);
    const std::span<const std::uint64_t> done = start->done.words();
    std::copy(done.begin(), done.end(), with_light_.begin());
    pixels_with_light_ = start->done.count();
  }
}

void Host::begin_frame(const core::FineDetail* detail) {
  core::expect(finished(), "a frame begins when the one before has ended");
  refinement_ = core::Refinement(wanted_, first_samples_, film_->width(), film_->height(), detail, film_->scale());
  std::fill(with_light_.begin(), with_light_.end(), 0);
  pixels_with_light_ = 0;
  deposits_saturated_ = 0;
}

std::uint32_t Host::take_light(std::uint32_t first, std::uint32_t more, const core::PixelSums& sums) {
  core::expect(first < film_->pixel_count() && more < film_->pixel_count() - first, "light falls on the picture");
  const std::uint32_t before = pixels_with_light_;
  for (std::uint32_t pixel = first; pixel <= first + more; ++pixel) {
    core::expect(refinement_.pass().has(pixel), "light falls on a pixel of the pass");
    pixels_with_light_ += has_light(pixel) ? 0 : 1;
    with_light_[pixel / 64] |= std::uint64_t{1} << (pixel % 64);
    deposits_saturated_ += film_->deposit(pixel, sums) ? 1 : 0;
    if (continuation_.watch) {
      continuation_.watch(*film_, refinement_, pixel);
    }
  }
  return pixels_with_light_ - before;
}

bool Host::next_pass() {
  if (!refinement_.next_pass(*film_, continuation_.ends_before)) {
    if (refinement_.result().is_cut_short && may_be_kept()) {
      core::Film film = *film_;
      core::Refinement refinement = refinement_;
      refinement.begin_chosen(film);
      continuation_.keep(film, refinement, core::PixelMask(static_cast<std::uint32_t>(film.pixel_count())));
    }
    return false;
  }
  std::fill(with_light_.begin(), with_light_.end(), 0);
  pixels_with_light_ = 0;
  return true;
}

core::PixelMask Host::with_light() const {
  core::PixelMask mask(static_cast<std::uint32_t>(film_->pixel_count()));
  std::copy(with_light_.begin(), with_light_.end(), mask.words().begin());
  return mask;
}

void Host::report_progress(std::uint32_t pixels) const {
  if (progress_) {
    progress_(pixels, refinement_.pixel_count());
  }
}

}  // namespace dmpc::pictures
