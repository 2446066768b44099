#include "apps/show/stats/virtual.h"
#include "apps/frontend/line/number_text.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "apps/frontend/machine/machine_file.h"
#include "tests/apps/show/rendered.h"

namespace dmpc::apps::stats_virtual_test {

namespace {

Json counters(const RenderOptions& options) { return Json::parse(Rendered(options).json()); }

double sum(const Json& numbers) {
  double total = 0;
  for (const auto& [key, number] : numbers.items()) {
    total += number.get<double>();
  }
  return total;
}

/// All parts of a time in seconds but "total".
double sum_of_parts(Json times) {
  const double waiting = sum(times["waiting"]);
  times.erase("waiting");
  times.erase("total");
  return sum(times) + waiting;
}

constexpr Strategy strategies[] = {Strategy::svm, Strategy::replicated, Strategy::dataflow};

}  // namespace

TEST_CASE("what follows from virtual time is null with threads, and has the same keys with both runners") {
  for (const Strategy strategy : strategies) {
    const std::string threads = Rendered(small(strategy)).json(), virtually = Rendered(modelled(strategy)).json();
    CHECK(keys(threads, 1) == keys(virtually, 1));
    const Json of_threads = Json::parse(threads), of_model = Json::parse(virtually);
    for (const char* key : {"machine", "run_hash", "machine_digest", "virtual_seconds", "time_percent", "events", "links"}) {
      CHECK(of_threads[key].is_null());
      CHECK_FALSE(of_model[key].is_null());
    }
    CHECK(of_threads["runner"] == "threads");
    CHECK(of_model["runner"] == "virtual");
    CHECK(of_threads["nodes"][0]["virtual_seconds"].is_null());
    CHECK(of_threads["nodes"][0]["time_percent"].is_null());
    CHECK(of_threads["host"]["virtual_seconds"].is_null());
    CHECK(of_model["nodes"][0]["seconds"].is_null());
    CHECK(of_model["host"]["seconds"].is_null());
  }
}

TEST_CASE("the whole machine is told") {
  const nodes::Machine& paragon = find_machine_preset("paragon")->machine;
  CHECK(counters(modelled(Strategy::svm, "paragon"))["machine"] == machine_json(paragon));
}

TEST_CASE("the parts of every node's virtual time add up to the run's, and to a hundred percent") {
  for (const Strategy strategy : strategies) {
    const Json json = counters(modelled(strategy));
    const double total = json["virtual_seconds"]["total"].get<double>();
    CHECK(total > 0);
    REQUIRE(json["nodes"].size() == 3);
    for (const Json& node : json["nodes"]) {
      CHECK(node["virtual_seconds"]["total"] == total);
      CHECK(sum_of_parts(node["virtual_seconds"]) == doctest::Approx(total));
      CHECK(sum(node["time_percent"]) == doctest::Approx(100));
    }
    CHECK(sum_of_parts(json["virtual_seconds"]) == doctest::Approx(3 * total));
    CHECK(sum(json["time_percent"]) == doctest::Approx(100));
    CHECK(sum_of_parts(json["host"]["virtual_seconds"]) == doctest::Approx(total));
  }
}

TEST_CASE("waits for pages and for rays are waits for data") {
  RenderOptions one = modelled();
  one.pages.in_flight = 1;
  const Json pages = counters(one), rays = counters(modelled(Strategy::dataflow));
  const auto percent = [](const Json& json, const char* kind) {
    return 100 * json["virtual_seconds"]["waiting"][kind].get<double>() / (3 * json["virtual_seconds"]["total"].get<double>());
  };
  CHECK(percent(pages, "page_reply") > 0);
  CHECK(pages["time_percent"]["data_wait"] == doctest::Approx(percent(pages, "page_reply")));
  CHECK(pages["time_percent"]["starvation"] == doctest::Approx(percent(pages, "work_request") + percent(pages, "work_reply")));
  CHECK(percent(rays, "rays") > 0);
  CHECK(rays["time_percent"]["data_wait"] == doctest::Approx(percent(rays, "rays") + percent(rays, "forwarded")));
  CHECK(counters(modelled(Strategy::replicated))["time_percent"]["data_wait"] == 0.0);
}

TEST_CASE("every message between different nodes passes a link, and links are held for some time") {
  for (const Strategy strategy : strategies) {
    const Json json = counters(modelled(strategy)), links = json["links"];
    CHECK(links["messages"] > 0);
    CHECK(links["messages"] <= json["packets"]["sent"]);
    CHECK(links["hops"] >= links["messages"]);
    CHECK(links["busiest"] > 0.0);
    CHECK(links["busiest"] <= json["virtual_seconds"]["total"]);
  }
}

TEST_CASE("what each link carried adds up to what all did, and the busiest comes first") {
  for (const Strategy strategy : strategies) {
    const Json links = counters(modelled(strategy))["links"];
    CHECK(links["columns"] == Json({"from", "to", "messages", "bytes", "busy", "wait"}));
    CHECK(links["rows"].size() == links["used"]);
    CHECK(links["passages"] == links["hops"]);
    const auto sum_of = [&](std::size_t column) {
      double all = 0;
      for (const Json& row : links["rows"]) {
        all += row[column].get<double>();
      }
      return all;
    };
    CHECK(sum_of(2) == links["passages"].get<double>());
    CHECK(sum_of(3) == links["bytes"].get<double>());
    CHECK(sum_of(4) == doctest::Approx(links["busy"].get<double>()));
    CHECK(sum_of(5) == doctest::Approx(links["wait"].get<double>()));
    CHECK(links["rows"][0][4] == links["busiest"]);
  }
}

TEST_CASE("of many links 256 are listed") {
  RenderOptions options = modelled();
  options.computer.node_count = 64;
  options.computer.machine->has_memory_port = true;
  const Json links = counters(options)["links"];
  CHECK(links["used"].get<int>() > 256);
  CHECK(links["rows"].size() == 256);
}

TEST_CASE("memory ports are listed among the links and are no hops") {
  RenderOptions options = modelled();
  const Json without = counters(options)["links"];
  options.computer.machine->has_memory_port = true;
  const Json links = counters(options)["links"];
  CHECK(links["passages"] > links["hops"]);
  CHECK(links["used"] > without["used"]);
  CHECK(links.dump().find("\"memory 2\"") != std::string::npos);
  CHECK(without.dump().find("memory") == std::string::npos);
}

TEST_CASE("the digest is the machine's, whatever runs on it and whatever it is called") {
  RenderOptions options = modelled();
  const Json digest = counters(options)["machine_digest"];
  CHECK(digest == hash_text(find_machine_preset("ipsc2")->machine.digest()));
  options.computer.machine->name = "another";
  CHECK(counters(options)["machine_digest"] == digest);
  CHECK(counters(modelled(Strategy::dataflow))["machine_digest"] == digest);
  CHECK(counters(modelled(Strategy::svm, "cs2"))["machine_digest"] != digest);
}

TEST_CASE("the run's hash is of the events, the machine and the film") {
  const Rendered rendered(modelled());
  const Account account = account_of(*rendered.report);
  CHECK(Json::parse(rendered.json())["run_hash"] == hash_text(account.virtual_time->run_hash(account.film.hash())));
}

TEST_CASE("two runs of one machine have one hash, and another machine has another") {
  const auto hash = [](const RenderOptions& options) { return counters(options)["run_hash"].get<std::string>(); };
  CHECK(hash(modelled()) == hash(modelled()));
  CHECK(hash(modelled()) != hash(modelled(Strategy::svm, "ipsc860")));
  CHECK(hash(modelled()).size() == 16);
}

}  // namespace dmpc::apps::stats_virtual_test
