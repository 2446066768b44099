#include "apps/render/film_notes.h"

#include "apps/edge/line/number_text.h"
#include "core/picture/film_range.h"

namespace dmpc::apps {

namespace {

/// A picture whose brightest pixel has fewer of the film's steps is off by more than a 512th, so that 8 bits may show it.
constexpr double steps_min = 256;

std::string cut_note(const core::Film& film, const core::FilmRange& range) {
  return grouped(range.pixels_cut) + " of " + counted(film.pixel_count(), "pixel") +
         " are brighter than the film can hold and were cut, from a radiance of " + rounded(range.cut_from) +
         " on, so that their colours are wrong, too: lights that shine by a power of two less keep all other bits";
}

std::string dark_note(const core::Film& film, const core::FilmRange& range) {
  return "no pixel is brighter than " + rounded(range.brightest) + ", and the film counts light in steps of " +
         rounded(film.step()) + ", so that pixels are off by " + percent_text(50 * film.step() / range.brightest) +
         " and more: something else in the scene is far brighter, lights or materials that nothing shows";
}

std::string black_note(const core::Film& film, std::uint64_t lit) {
  return "the picture is black, though " + counted(lit, "shadow ray") +
         " reached a light: what each of them brought is less than half of the film's steps of " + rounded(film.step());
}

}  // namespace

std::vector<std::string> film_notes(const core::Film& film, std::uint64_t lit) {
  const core::FilmRange range = range_of(film);
  std::vector<std::string> notes;
  if (range.pixels_cut > 0) {
    notes.push_back(cut_note(film, range));
  }
  if (range.brightest > 0 && range.brightest < steps_min * film.step()) {
    notes.push_back(dark_note(film, range));
  } else if (range.brightest == 0 && lit > 0) {
    notes.push_back(black_note(film, lit));
  }
  return notes;
}

}  // namespace dmpc::apps
