#include "apps/computer/program_work.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "core/trace/charge.h"

namespace dmpc::apps::program_work_test {

namespace {

using Names = std::vector<std::string>;

const std::vector<OperationNeed> two = {{"addition", 1}, {"division", 9}};
const std::vector<OperationNeed> five = {{"a", 1}, {"b", 1}, {"c", 1}, {"d", 1}, {"e", 1}};

ProgramWork packet_work(const std::vector<OperationNeed>& operations) {
  return program_work(vocabulary_of({.operations = operations}));
}
ProgramWork task_work(const std::vector<OperationNeed>& operations) { return program_work(vocabulary_of_tasks(operations)); }

/// The name of what a call is that is charged these.
std::string name_of_call(const ProgramWork& work, const nodes::Charges& charges,
                         nodes::Activity activity = nodes::Activity::work) {
  return work.names.at(work.work_of({.activity = activity, .before = {}, .after = charges}));
}

}  // namespace

TEST_CASE("a program with packets is busy with its operations, with what has none, and with messages") {
  const ProgramWork work = packet_work(two);
  CHECK(work.names == Names{"'addition'", "'division'", "other computing", "messages"});
  CHECK(name_of_call(work, {.count = {3, 0}}) == "'addition'");
  CHECK(name_of_call(work, {.count = {0, 1}}) == "'division'");
  CHECK(name_of_call(work, {.count = {1, 1}}) == "'addition'");
  CHECK(name_of_call(work, {}) == "other computing");
  CHECK(name_of_call(work, {}, nodes::Activity::send) == "messages");
  CHECK(name_of_call(work, {}, nodes::Activity::take_over) == "messages");
  CHECK(packet_work({}).names == Names{"computing", "messages"});
}

TEST_CASE("of many operations the first are told apart") {
  const ProgramWork work = packet_work(five);
  CHECK(work.names == Names{"'a'", "'b'", "'c'", "'d'", "other computing", "messages"});
  CHECK(name_of_call(work, {.count = {0, 0, 0, 0, 1}}) == "other computing");
  CHECK(task_work(five).names == Names{"'a'", "'b'", "'c'", "other computing", "pages", "messages"});
}

TEST_CASE("tasks are busy with pages, too, where these are installed or served and nothing else is done") {
  const ProgramWork work = task_work(two);
  nodes::Charges charges;
  charges[core::Charge::page_install] = 1;
  CHECK(name_of_call(work, charges) == "pages");
  CHECK(name_of_call(work, {}, nodes::Activity::serve) == "pages");
  charges[core::Charge::cached_lookup] = 1;
  CHECK(name_of_call(work, charges) == "other computing");
  charges[charge_of(1)] = 1;
  CHECK(name_of_call(work, charges) == "'division'");
}

}  // namespace dmpc::apps::program_work_test
