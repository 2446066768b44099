#include "apps/foreign/mesh/collada_losses.h"

#include <cstdint>

#include "apps/foreign/mesh/count_note.h"
#include "apps/foreign/text/xml_tags.h"

namespace dmpc::apps {

void note_collada_losses(std::string_view text, std::vector<std::string>& notes) {
  std::uint64_t edges = 0, set = 0, by_reference = 0, other_profiles = 0, no_meshes = 0;
  for_each_tag(text, [&](const Tag& tag) {
    if (tag.is("wrap_s") || tag.is("wrap_t")) {
      for_each_word(content(text, tag), " \t\r\n", [&](std::string_view word) { edges += word == "WRAP" ? 0 : 1; });
    }
    other_profiles += tag.is("profile_GLSL") || tag.is("profile_GLES") || tag.is("profile_GLES2") || tag.is("profile_CG") ||
                              tag.is("profile_BRIDGE")
                          ? 1
                          : 0;
    no_meshes += tag.is("spline") || tag.is("brep") || tag.is("convex_mesh") ? 1 : 0;
    set += tag.is("setparam") ? 1 : 0;
    by_reference += tag.is("param") && attribute(tag, "ref") ? 1 : 0;
  });
  note_count(notes, "edges of textures other than WRAP (wrap_s, wrap_t), shown as WRAP", edges);
  note_count(notes, "splines, boundaries and hulls (spline, brep, convex_mesh), which are not shown", no_meshes);
  note_count(notes, "profiles of effects other than COMMON, which are not shown: an effect without that is grey", other_profiles);
  note_count(notes, "parameters of effects that materials set (setparam), which are not followed", set);
  note_count(notes, "values by a parameter's name (param ref), which are not followed", by_reference);
}

}  // namespace dmpc::apps
