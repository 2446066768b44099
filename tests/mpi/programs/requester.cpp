// Asks for squares, well or badly: what tests start on ranks.
#include <cstdlib>
#include <string>

#include "tests/apps/computer/requester.h"

int main(int count, char** words) {
  using namespace dmpc;
  std::uint32_t questions = 10, fault = 0, fewer = 0;
  const auto program = [&] { return tests::requester(questions, static_cast<tests::Fault>(fault)); };
  return run<tests::Requester>(count, words,
                               {.description = "Ask for squares",
                                .options = {{"--questions", &questions, 0, 1'000'000, "Of each node"},
                                            {"--fault", &fault, 0, 13, "What it does wrong"},
                                            {"--fewer", &fewer, 0, 1, "Whether rank 1 declares less than others"}},
                                .needs =
                                    [&](std::uint32_t nodes) {
                                      Needs needs = program().needs(nodes);
                                      const char* const rank = std::getenv("OMPI_COMM_WORLD_RANK");
                                      needs.memory[1].bytes -= fewer == 1 && rank != nullptr && rank == std::string("1") ? 64 : 0;
                                      return needs;
                                    },
                                .make = [&](Node& node) { return program().make(node); },
                                .result = tests::requester(0).result});
}
