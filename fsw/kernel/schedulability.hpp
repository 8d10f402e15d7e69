// Will every rate group always be done before its next beat is due? Answered before time starts, from the
// table alone: budgets as worst-case execution times, fixed priorities, preemption.
//
// The response time R of a group is the smallest solution of R = C + interference(R), with C the sum of its
// budgets, counted over all threads of its priority or above that may take a processor from it:
//  - all of them tied to its processor, or one processor: sum of ceil(R / T) C
//    (Joseph and Pandya, Finding response times in a real-time system, 1986). Exact for groups that may begin
//    together; offsets only help and are left out.
//  - where threads may move between processors: sum of ceil((R + R' - C') / T') C', as a beat begun before
//  may
//    still run; for a group that may itself move this is divided by the number of processors, and is nothing
//    for fewer such threads than processors (after Bertogna and Cirinei, Response-time analysis for globally
//    scheduled symmetric multiprocessor platforms, 2007).
//  - a step shared among threads waits for the last of them: interference anywhere counts in full.
// Ports never wait, so nothing blocks. Groups of priority 0 are ordinary threads: nothing is promised to
// them, and they take nothing from the others.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "fsw/kernel/rate_group.hpp"
#include "fsw/kernel/tick.hpp"

namespace omma {

/// The table cannot hold its deadlines; the message has the numbers, a sentence a group.
class ScheduleError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct GroupResponse {
  TimeNs period_ns = 0;    ///< and deadline
  TimeNs budget_ns = 0;    ///< of all its components
  TimeNs response_ns = 0;  ///< longest time from due to done; for an ordinary group its budgets alone
  double utilisation = 0;  ///< of one processor, the workers' threads included
  bool real_time = false;
  bool holds = false;  ///< response within the period; where this is false the response is a lower bound
};

struct Schedulability {
  std::vector<GroupResponse> groups;        ///< in the table's order
  double utilisation = 0;                   ///< of all processors, by real-time groups
  std::vector<std::string> faults;          ///< a sentence a group that does not hold
  std::vector<std::string> without_budget;  ///< components of real-time groups that are not counted
};

/// @param processors  the groups may run on, at least 1
Schedulability analyse_schedule(const RateGroupTable& table, int processors);

/// @throws ScheduleError when a group's beats may overrun
void check_schedule(const RateGroupTable& table, int processors);

/// The schedule as a table to be read: periods, priorities, processors, budgets, reactions, response times.
std::string schedule_text(const RateGroupTable& table, int processors);

/// Processors this process may use.
int processors_here();

}  // namespace omma
