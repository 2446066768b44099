// dmpc_lab: all commands of dmpc, which starts it.

#include "apps/main/allocation.h"
#include "apps/main/commands.h"
#include "apps/program/run_program.h"

int main(int count, char** values) {
  dmpc::apps::keep_freed_memory();
  return dmpc::apps::run_program(dmpc::apps::parse_command_line, count, values);
}
