#include "apps/edge/line/foreign_option.h"

#include <algorithm>
#include <cctype>
#include <iterator>

namespace dmpc::apps {
namespace {

struct Row {
  const char* name;  ///< without dashes
  ForeignOption option;
};

constexpr ForeignOption resolution{"--resolution", "the pixels of both sides"};
constexpr ForeignOption samples{"--samples", "the rays through each pixel"};
constexpr ForeignOption nodes{"--nodes", "each of which is a thread"};
constexpr ForeignOption camera{"--camera", "which has all of it"};
constexpr ForeignOption angle{"--camera", "which ends with the angle"};
constexpr ForeignOption depth{"--depth", "the longest chain of reflections and refractions"};
constexpr ForeignOption picture{"--output", "the picture"};
constexpr ForeignOption draft{"--quality", "of which draft is the quick one"};

constexpr Row rows[] = {
    {"fov", angle},
    {"angle", angle},
    {"vfov", angle},
    {"hfov", angle},
    {"eye", camera},
    {"from", camera},
    {"origin", camera},
    {"at", camera},
    {"look-at", camera},
    {"lookat", camera},
    {"target", camera},
    {"camera-position", camera},
    {"width", resolution},
    {"height", resolution},
    {"w", resolution},
    {"res", resolution},
    {"size", resolution},
    {"xres", resolution},
    {"yres", resolution},
    {"xresolution", resolution},
    {"yresolution", resolution},
    {"+w", resolution},
    {"+h", resolution},
    {"spp", samples},
    {"s", samples},
    {"pixelsamples", samples},
    {"pixel-samples", samples},
    {"samples-per-pixel", samples},
    {"n", nodes},
    {"np", nodes},
    {"j", nodes},
    {"jobs", nodes},
    {"t", nodes},
    {"threads", nodes},
    {"nthreads", nodes},
    {"cores", nodes},
    {"procs", nodes},
    {"maxdepth", depth},
    {"max-depth", depth},
    {"bounces", depth},
    {"max-bounces", depth},
    {"outfile", picture},
    {"out", picture},
    {"render-output", picture},
    {"quick", draft},
    {"preview-quality", draft},
    {"preview", {"--serve", "which has replaced it, and shows the picture in a browser as it comes"}},
};

/// "w", of "--w", "-w" and "-W640"; "+w", of "+W640"; names of several letters keep their digits.
std::string bare(const std::string& name) {
  const std::size_t begin = std::min(name.find_first_not_of('-'), name.size());
  std::string word;
  std::transform(name.begin() + static_cast<std::ptrdiff_t>(begin), name.end(), std::back_inserter(word),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  const std::size_t letters = word.starts_with('+') ? 2 : 1;
  return word.find_first_not_of("0123456789", letters) == std::string::npos ? word.substr(0, letters) : word;
}

}  // namespace

std::optional<ForeignOption> foreign_option(const std::string& name) {
  const std::string word = bare(name);
  const auto* const found = std::find_if(std::begin(rows), std::end(rows), [&](const Row& row) { return word == row.name; });
  return found == std::end(rows) ? std::nullopt : std::optional(found->option);
}

}  // namespace dmpc::apps
