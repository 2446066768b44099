#include "apps/show/page/played_run.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "apps/frontend/system/base64.h"
#include "apps/show/page/page_data.h"
#include "apps/show/page/play_data.h"
#include "apps/show/page/player.h"
#include "apps/show/page/typed_array.h"
#include "core/base/expect.h"
#include "core/picture/heat_kind.h"
#include "nodes/node_id.h"

namespace dmpc::apps::html {

namespace {

using nlohmann::json;

constexpr std::uint64_t byte_limit = 255;
constexpr std::uint64_t picture_side_limit = std::uint64_t{1} << 20U;  ///< limit of a picture's side
constexpr std::size_t step_count_limit = std::size_t{1} << 16U, list_size_limit = 4096;
constexpr std::size_t word_bytes_limit = std::size_t{1} << 16U;
constexpr double scale_limit = 1e12;

[[noreturn]] void refuse(const std::string& file, const std::string& what) {
  throw core::InputError(file + ": " + what + "; expected a page that dmpc render --report=FILE.html wrote");
}

json data_of(std::string_view page, const std::string& file) {
  std::optional<json> data = data_in(page, file);
  if (!data) {
    refuse(file, page.find("<html") == std::string_view::npos ? "this is no page" : "this page plays no run");
  }
  if (data->contains("runs")) {
    refuse(file, "this page has two runs side by side already");
  }
  if (!data->contains("format") && data->contains("forecast")) {
    refuse(file, "this is the page of a study, which plays no run");
  }
  if (const json format = data->value("format", json()); format != play_format) {
    throw core::InputError(file + ": its data have format " +
                           format.dump(-1, ' ', true, json::error_handler_t::replace).substr(0, 40) + ", expected format " +
                           std::to_string(play_format) + "; compare it with the dmpc that wrote it, or render it again");
  }
  return std::move(*data);
}

/// The sizes on which all other data depend.
struct Sizes {
  std::uint64_t nodes, steps, cells, total_ns;
};

/// Returns the base64 text of a picture's bytes. Nothing if there is none.
std::string picture_in(std::string_view page) {
  const std::size_t image = page.find("<img class=\"picture\"");
  constexpr std::string_view begin = "src=\"data:image/png;base64,";
  const std::size_t at = image == std::string_view::npos ? image : page.find(begin, image);
  if (at == std::string_view::npos) {
    return "";
  }
  page.remove_prefix(at + begin.size());
  const std::optional<std::vector<std::byte>> bytes = bytes_of_base64(page.substr(0, page.find('"')));
  std::string picture;
  for (const std::byte byte : bytes.value_or(std::vector<std::byte>())) {
    picture += static_cast<char>(byte);
  }
  return picture;
}

/// Returns the list of entry_of() of each entry; there are at most `most`.
template <class EntryOf>
json list_of(const DataPart& list, std::size_t most, const EntryOf& entry_of) {
  json all = json::array();
  for (std::size_t i = 0; i < list.size(most); ++i) {
    all.push_back(entry_of(list.at(i)));
  }
  return all;
}

/// The optional keys; texts, numbers and lists of these on which nothing else depends are taken one by one.
json head_of(const DataPart& data) {
  json head = {{"format", play_format}};
  for (const char* const key : {"scene", "computer"}) {
    head[key] = data.at(key).text();
  }
  const std::string clock = data.at("clock").text();
  if (clock != "virtual time" && clock != "wall clock") {
    data.at("clock").refuse("virtual time or wall clock");
  }
  head["clock"] = clock;
  head["words"] = list_of(data.at("words"), list_size_limit, [](const DataPart& word) {
    if (!is_shell_word(word.text(word_bytes_limit))) {
      word.refuse("a word of a command as a shell takes it, in quotes where it needs some");
    }
    return word.text(word_bytes_limit);
  });
  head["total_ns"] = data.at("total_ns").whole(exact_number_max, 1);
  head["step_ns"] = data.at("step_ns").whole(exact_number_max, 1);
  head["nodes"] = data.at("nodes").whole(nodes::node_count_max, 1);
  head["steps"] = data.at("steps").whole(step_count_limit, 1);
  return head;
}

void add_picture_sizes(json& head, const DataPart& data) {
  const std::uint64_t width = data.at("width").whole(picture_side_limit, 1),
                      height = data.at("height").whole(picture_side_limit, 1);
  const std::uint64_t cell = data.at("cell").whole(picture_side_limit, 1);
  const std::uint64_t wide = (width + cell - 1) / cell, high = (height + cell - 1) / cell;
  if (wide * high > play_cells_max || data.at("wide").whole(picture_side_limit) != wide ||
      data.at("high").whole(picture_side_limit) != high) {
    data.at("cell").refuse("cells of a picture of that size, at most " + std::to_string(play_cells_max));
  }
  head.update({{"width", width}, {"height", height}, {"cell", cell}, {"wide", wide}, {"high", high}});
}

/// Scale of numbers that are added up.
double scale_of(const DataPart& scale) {
  const double number = scale.number();
  if (!(number >= 0 && number <= scale_limit)) {
    scale.refuse("a number from 0 to 1e12");
  }
  return number;
}

json fields_of(const DataPart& fields, const Sizes& sizes) {
  return list_of(fields, core::heat_kind_names.size(), [&sizes](const DataPart& field) -> json {
    const std::string name = field.at("name").text();
    const std::uint64_t most = name == "node" ? sizes.nodes : exact_number_max;
    return {{"name", name},
            {"meaning", field.at("meaning").text()},
            {"unit", field.at("unit").text()},
            {"scale", scale_of(field.at("scale"))},
            {"values", field.at("values").numbers(sizes.cells, most)}};
  });
}

json shares_of(const DataPart& works, const Sizes& sizes) {
  return list_of(works, byte_limit, [&sizes](const DataPart& work) -> json {
    const std::string name = work.at("name").text();
    if (name == run_column || name == rest_column) {
      work.at("name").refuse("something that nodes do");
    }
    return {{"name", name},
            {"ns", work.at("ns").whole(exact_number_max)},
            {"shares", work.at("shares").numbers(sizes.nodes * sizes.steps, byte_limit)}};
  });
}

/// Reads [[text or whole number]], of which `texts` are texts.
json rows_of(const DataPart& rows, std::size_t texts, const std::vector<std::uint64_t>& most) {
  return list_of(rows, list_size_limit, [&](const DataPart& row) {
    json cells = json::array();
    for (std::size_t column = 0; column < texts + most.size(); ++column) {
      const DataPart cell = row.at(column);
      cells.push_back(column < texts ? json(cell.text()) : json(cell.whole(most[column - texts])));
    }
    return cells;
  });
}

/// Returns whether it is "host", or another kind of a machine's parts and its number: a script positions it by that.
bool is_place(const std::string& name) {
  const std::size_t blank = name.find(' ');
  if (blank == std::string::npos) {
    return name == "host";
  }
  const std::string number = name.substr(blank + 1);
  return !number.empty() && number.size() <= 6 && number.find_first_not_of("0123456789") == std::string::npos;
}

json named_times(const DataPart& times) {
  return list_of(times, list_size_limit, [](const DataPart& time) -> json {
    return {{"name", time.at("name").text()}, {"ns", time.at("ns").whole(exact_number_max)}};
  });
}

json causes_of(const DataPart& causes, const Sizes& sizes) {
  json found = {{"count", causes.at("count").whole(exact_number_max)},
                {"left_out_ns", causes.at("left_out_ns").whole(exact_number_max)}};
  found["kinds"] = list_of(causes.at("kinds"), byte_limit, [](const DataPart& kind) { return kind.text(); });
  const std::size_t kinds = found["kinds"].size();
  const std::size_t count = causes.at("node").count_numbers(sizes.nodes);
  for (const auto& [column, most] : std::vector<std::pair<const char*, std::uint64_t>>{{"node", sizes.nodes},
                                                                                       {"begin", exact_number_max},
                                                                                       {"length", exact_number_max},
                                                                                       {"kind", kinds},
                                                                                       {"peer", sizes.nodes},
                                                                                       {"left", exact_number_max},
                                                                                       {"request", kinds},
                                                                                       {"from", sizes.nodes},
                                                                                       {"at", exact_number_max}}) {
    found[column] = causes.at(column).numbers(count, most);
  }
  return found;
}

json path_of(const DataPart& path, const Sizes& sizes) {
  return {{"messages", path.at("messages").whole(exact_number_max)},
          {"node", path.at("node").whole(sizes.nodes)},
          {"from_ns", path.at("from_ns").whole(exact_number_max)},
          {"parts", named_times(path.at("parts"))},
          {"kinds", named_times(path.at("kinds"))}};
}

json pairs_of(const DataPart& pairs, const Sizes& sizes) {
  const std::uint64_t side = pairs.at("side").whole(sizes.nodes + 1);
  json found = {{"side", side}};
  for (const char* const key : {"what", "row", "column"}) {
    found[key] = pairs.at(key).text();
  }
  const std::size_t count = pairs.has("places") ? pairs.at("places").count_numbers(side == 0 ? 0 : side * side - 1) : side * side;
  if (pairs.has("places")) {
    found["places"] = pairs.at("places").numbers(count, exact_number_max);
  }
  found["counts"] = pairs.at("counts").numbers(count, exact_number_max);
  return found;
}

json steps_of(const DataPart& rows, std::size_t count) {
  const std::uint64_t steps = rows.at("steps").whole(step_count_limit, 1);
  return {{"step_ns", rows.at("step_ns").whole(exact_number_max, 1)},
          {"steps", steps},
          {"most", rows.at("most").whole(exact_number_max, byte_limit)},
          {"values", rows.at("values").numbers(count * steps, byte_limit)}};
}

json over_of(const DataPart& over, const json& head) {
  json found = {{"levels", list_of(over.at("levels"), byte_limit, [](const DataPart& level) {
                   json steps = steps_of(level, 1);
                   steps["name"] = level.at("name").text();
                   return steps;
                 })}};
  if (over.has("links")) {
    found["links"] = steps_of(over.at("links"), head["links"].size());
  }
  if (over.has("pages")) {
    found["pages"] = steps_of(over.at("pages"), head["pages"].size());
  }
  if (over.has("pairs")) {
    if (!head.contains("pairs")) {
      over.at("pairs").refuse("pairs of the whole run, too");
    }
    const auto side = head["pairs"]["side"].get<std::size_t>();
    found["pairs"] = steps_of(over.at("pairs"), side * side);
    found["pairs"]["what"] = over.at("pairs").at("what").text();
  }
  return found;
}

void add_exchange(json& head, const DataPart& data, const Sizes& sizes) {
  head["links"] = rows_of(data.at("links"), 2, {exact_number_max, exact_number_max, exact_number_max, exact_number_max});
  for (const json& link : head["links"]) {
    if (!is_place(link[0]) || !is_place(link[1])) {
      data.at("links").refuse("links between places such as \"node 3\" and \"host\"");
    }
  }
  head["pages"] = rows_of(data.at("pages"), 0, {exact_number_max, sizes.nodes, exact_number_max});
  if (data.has("fetched")) {
    head["fetched"] = data.at("fetched").whole(exact_number_max);
  }
  if (data.has("topology")) {
    const DataPart topology = data.at("topology");
    head["topology"] = {{"kind", topology.at("kind").text()},
                        {"columns", topology.at("columns").whole(nodes::node_count_max, 1)},
                        {"uplinks", topology.at("uplinks").whole(nodes::node_count_max)}};
  } else if (!head["links"].empty()) {
    data.refuse("a topology of the links");
  }
  if (data.has("pairs")) {
    head["pairs"] = pairs_of(data.at("pairs"), sizes);
  }
  if (data.has("over")) {
    head["over"] = over_of(data.at("over"), head);
  }
}

}  // namespace

PlayedRun played_run(std::string_view page, const std::string& file) {
  const json read = data_of(page, file);
  const DataPart data(read, file + ": data");
  PlayedRun run{.data = head_of(data), .stats = std::nullopt, .picture = picture_in(page)};
  json& head = run.data;
  add_picture_sizes(head, data);
  const Sizes sizes{head["nodes"], head["steps"], head["wide"].get<std::uint64_t>() * head["high"].get<std::uint64_t>(),
                    head["total_ns"]};
  head["done"] = data.at("done").numbers(sizes.cells, done_parts);
  head["fields"] = fields_of(data.at("fields"), sizes);
  head["works"] = shares_of(data.at("works"), sizes);
  head["waits"] = shares_of(data.at("waits"), sizes);
  add_exchange(head, data, sizes);
  if (data.has("causes") && data.has("path")) {
    head["causes"] = causes_of(data.at("causes"), sizes);
    head["path"] = path_of(data.at("path"), sizes);
  }
  if (data.has("stats")) {
    run.stats = data_text(read["stats"]);
  }
  return run;
}

}  // namespace dmpc::apps::html
