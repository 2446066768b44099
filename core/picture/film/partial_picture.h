// A picture under way, in the terms of no strategy: what one run leaves behind, so that another can go on with it.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "core/picture/film/film.h"
#include "core/picture/sampling/refinement.h"

namespace dmpc::core {

/// What is known of a picture between two samples. Every light on the film is of a sample that is wholly done.
struct PartialPicture {
  /// The light of the passes that have ended and of what is done of the one under way; the samples are those of the former alone.
  Film film;
  std::uint32_t passes = 1;          ///< the one under way included
  Pass pass;                         ///< under way
  PixelMask done;                    ///< of its pixels: all light of their samples is on the film
  std::vector<PixelPast> past = {};  ///< where the picture is refined, of each pixel; in the first pass of no account

  /// Pixels of the pass that are still to be rendered.
  PixelMask missing() const;
  /// The samples of all pixels, in passes that have ended and in the one under way.
  std::uint64_t samples_done() const;
};

/// What a run has under way.
PartialPicture partial_picture(const Film& film, const Refinement& refinement, const PixelMask& done);

/// What decides which partial pictures there can be.
struct PictureTerms {
  std::uint32_t samples = 1;                                      ///< of every pixel, in the first pass
  RefinementOptions refinement;                                   ///< what of the others
  double radiance_max = std::numeric_limits<double>::infinity();  ///< of a sample, in any channel, but for rounding
  FilmScale film_scale = {};                                      ///< of the film
};

/// What the picture says that cannot be, as a part of a sentence; nullptr if it could have come about. It looks at passes, masks,
/// samples and the light that these can have brought, not at whether it is the light of this scene or the right choice of pixels.
const char* fault_of(const PartialPicture& picture, const PictureTerms& terms);

/// How a run goes on from another, lets others go on from it, and lets somebody look on. Called on the host's thread; if a
/// function throws, the run ends with that.
struct Continuation {
  const PartialPicture* start = nullptr;  ///< where it begins: of the same picture, and outlives the run; nothing: at nothing
  /// Whether what is done should be kept now: asked whenever light arrives. May be empty, if `keep` is.
  std::function<bool()> is_due = {};
  /// Keeps a picture under way: the film, the pass, and which of its pixels are done, as in PartialPicture.
  std::function<void(const Film& film, const Refinement& pass, const PixelMask& done)> keep = {};
  /// Told of every pixel of the pass to which light has come, when it is on the film. May be empty.
  std::function<void(const Film& film, const Refinement& pass, std::uint32_t pixel)> watch = {};
};

}  // namespace dmpc::core
