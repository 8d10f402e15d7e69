// What the status sample tells: the states of the services, put together.
#pragma once

#include "fsw/services/commander.hpp"
#include "fsw/services/limit_watch.hpp"
#include "fsw/services/mode.hpp"
#include "fsw/services/parameters.hpp"

namespace omma::telemetry {

struct SpacecraftStatus {
  CommanderState commands;
  ParameterState parameters;
  ModeState mode;
  LimitCounts limits;
  friend bool operator==(const SpacecraftStatus&, const SpacecraftStatus&) = default;
};

}  // namespace omma::telemetry
