// What is said of options that dmpc has not, and that somebody knows: from other renderers, or from a dmpc that had them.
#pragma once

#include <optional>
#include <string>

namespace dmpc::apps {

/// An option of ours that does what another program's does.
struct ForeignOption {
  const char* ours;  ///< "--resolution"
  const char* note;  ///< what of it is meant: "the pixels of both sides"
};

/// Our option for `name` as pbrt, Mitsuba, Blender, POV-Ray or YafaRay spell it: "--fov", "-fov", "-j8", "+W640". Nothing if it
/// is not known.
std::optional<ForeignOption> foreign_option(const std::string& name);

/// What to say in place of an option that commands had, "--preview", one of them alone, "bench error --pictures", or a word of an
/// option, "--no-skip=empty-space", and what that does: a sentence without its dot. Empty if it is none of those.
std::string said_instead_of(const std::string& name);

}  // namespace dmpc::apps
