// Hints for options that dmpc does not have, but users know from other renderers or older versions of dmpc.
#pragma once

#include <optional>
#include <string>

namespace dmpc::apps {

/// An option of ours that does what another program's does.
struct ForeignOption {
  std::string ours;  ///< "--resolution"
  std::string note;  ///< the part of it that is meant: "the pixels of both sides"
};

/// Our option for `name` as pbrt, Mitsuba, Blender, POV-Ray or YafaRay spell it: "--fov", "-fov", "-j8", "+W640". Nothing if it
/// is not known.
std::optional<ForeignOption> foreign_option(const std::string& name);

/// A hint for an option that older versions had, "--preview", for one that a single command had, "bench error --pictures", or for
/// a value of an option, "--no-skip=empty-space", with its effect: a sentence without its dot. Empty for any other option.
std::string said_instead_of(const std::string& name);

/// Today's word for a value that was renamed, "good" for "--quality=default"; empty for any other.
std::string renamed_value(const std::string& option_and_value);

}  // namespace dmpc::apps
