// A partly rendered picture, independent of the strategy: what one run leaves behind, so that another can resume it.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "core/picture/film/film.h"
#include "core/picture/sampling/refinement.h"

namespace dmpc::core {

/// The state of a picture between two samples. All light on the film belongs to samples that are complete.
struct PartialPicture {
  /// The light of the passes that have ended and of finished pixels of the current one; sample counts are those of the former.
  Film film;
  std::uint32_t passes = 1;          ///< including the current one
  Pass pass;                         ///< the current one
  PixelMask done;                    ///< its pixels for which all light of their samples is on the film
  std::vector<PixelPast> past = {};  ///< one for each pixel if the picture is refined; in the first pass unused

  /// Pixels of the pass that still have to be rendered.
  PixelMask missing() const;
  /// The samples of all pixels, in ended passes and the current one.
  std::uint64_t samples_done() const;
};

/// The state of a run.
PartialPicture partial_picture(const Film& film, const Refinement& refinement, const PixelMask& done);

/// What determines which partial pictures are possible.
struct PictureTerms {
  std::uint32_t samples = 1;                                      ///< per pixel, in the first pass
  RefinementOptions refinement;                                   ///< for the other passes
  double radiance_max = std::numeric_limits<double>::infinity();  ///< a sample's maximum in any channel, up to rounding
  FilmScale film_scale = {};                                      ///< the film's
};

/// What is impossible about the picture, as a part of a sentence; nullptr if it may be right. Checks passes, masks, samples and
/// the light that these can have brought, not whether it is the light of this scene or the right choice of pixels.
const char* fault_of(const PartialPicture& picture, const PictureTerms& terms);

/// How a run resumes another, lets others resume it, and is observed. Called on the host's thread; if a function throws, the run
/// ends with its exception.
struct Continuation {
  const PartialPicture* start = nullptr;  ///< a state of the same picture, outlives the run; nullptr: from the beginning
  /// Whether the state should be saved now: called whenever light arrives. May be empty if `keep` is.
  std::function<bool()> is_due = {};
  /// Saves a partial picture: the film, the pass, and which of its pixels are done, as in PartialPicture.
  std::function<void(const Film& film, const Refinement& pass, const PixelMask& done)> keep = {};
  /// Called for every pixel of the pass whose light has arrived, when it is on the film. May be empty.
  std::function<void(const Film& film, const Refinement& pass, std::uint32_t pixel)> watch = {};
  /// Called between passes. If it ends the picture, the state before the pass that was chosen is kept.
  EndsBefore ends_before = {};
};

}  // namespace dmpc::core
