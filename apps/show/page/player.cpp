#include "apps/show/page/player.h"

#include <algorithm>

#include "apps/frontend/show/page/web_part.h"

namespace dmpc::apps::html {

extern const WebPart play_style, what_if_style;
extern const WebPart play_script, levels_script, links_script, pairs_script, pages_script, why_script, what_if_played_script,
    player_script;

namespace {

using nlohmann::json;

bool has(const json& run, const char* key) { return run.contains(key) && !run[key].empty(); }

bool has_levels(const json& run) { return run.contains("over") && has(run["over"], "levels"); }

}  // namespace

void add_player(Page& page, const json& data) {
  const auto any = [&data](const auto& test) {
    return data.contains("runs") ? std::any_of(data["runs"].begin(), data["runs"].end(), test) : test(data);
  };
  const auto any_has = [&any](const char* key) { return any([key](const json& run) { return has(run, key); }); };
  page.add_style(play_style);
  page.add_data("data", data_text(data));
  page.add_script(play_script);
  if (any(has_levels)) {
    page.add_script(levels_script);
  }
  if (any_has("topology")) {
    page.add_script(links_script);
  }
  if (any_has("pairs")) {
    page.add_script(pairs_script);
  }
  if (any_has("pages")) {
    page.add_script(pages_script);
  }
  if (any_has("causes")) {
    page.add_script(why_script);
  }
  if (data.contains("forecast")) {
    page.add_style(what_if_style);
    page.add_script(what_if_played_script);
  }
  page.add_script(player_script);
}

std::string data_text(const json& data) { return data.dump(-1, ' ', true, json::error_handler_t::replace); }

}  // namespace dmpc::apps::html
