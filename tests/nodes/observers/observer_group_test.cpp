#include "nodes/observers/observer_group.h"

#include <doctest/doctest.h>

#include <string>

#include "nodes/program.h"

namespace dmpc::nodes::observer_group_test {

namespace {

/// Writes down what it is told, in letters.
class LetterScribe final : public Observer {
 public:
  explicit LetterScribe(std::string& reported) : reported_(reported) {}
  void ended(const Span& /*span*/, const Program& /*program*/) override { reported_ += 'e'; }
  void sent(const Passing& /*packet*/) override { reported_ += 's'; }
  void received(const Passing& /*packet*/) override { reported_ += 'r'; }
  void worked(const Worked& /*worked*/) override { reported_ += 'w'; }

 private:
  std::string& reported_;
};

class NoProgram final : public Program {
 public:
  void receive(const Packet& /*packet*/) override {}
  bool work() override { return false; }
  bool finished() const override { return true; }
  std::string describe() const override { return ""; }
};

}  // namespace

TEST_CASE("all who look on are told everything, in order") {
  std::string both;
  LetterScribe first(both), second(both);
  ObserverGroup group({&first, &second});
  group.ended({}, NoProgram());
  group.sent({});
  group.received({});
  group.worked({});
  CHECK(both == "eessrrww");
}

TEST_CASE("nobody can look on, too") { ObserverGroup({}).sent({}); }

}  // namespace dmpc::nodes::observer_group_test
