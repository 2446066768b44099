// Claims of the article's text as rows of a table.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "apps/frontend/table/table.h"
#include "apps/lab/study/paper/catalogue.h"
#include "apps/lab/study/paper/data.h"
#include "apps/lab/study/paper/runs.h"

namespace dmpc::apps {

inline constexpr const char *held = "held", *not_held = "not held", *tie = "a tie", *not_judged = "not judged";

/// Times that differ by no more than this share count as equal.
inline constexpr double tie_share = 0.01;

class Claims {
 public:
  /// Prices are fitted to the article's resolution, so pictures of another resolution do not judge its claims.
  explicit Claims(std::uint32_t resolution)
      : is_judged_(resolution == paper_resolution),
        table_("What the text claims", {{"claim"}, {"verdict"}, {"found"}, {"why"}}) {}

  /// `why`: of a claim that is not held, as far as it is known.
  void add(const std::string& claim, bool is_held, const std::string& found, const std::string& why = {}) {
    add(claim, is_held ? held : not_held, found, why);
  }
  void add(const std::string& claim, const char* verdict, const std::string& found, const std::string& why = {}) {
    table_.add_row({claim, is_judged_ ? verdict : not_judged, found, verdict == held ? std::string() : why});
  }
  Table table() && { return std::move(table_); }

 private:
  bool is_judged_;
  Table table_;
};

/// Adds the claim that trees of extents need less memory but more time than a subdivision of space; these are the runs on one
/// node with the whole scene.
void claim_extents(Claims& rows, const PaperResults& results, const RunsByScene& in_space, const RunsByScene& in_extents);

}  // namespace dmpc::apps
