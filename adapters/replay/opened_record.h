// A record that fits the run in which it is played.
#pragma once

#include "adapters/scene/scene.h"
#include "coupler/exchange/exchange_record.h"
#include "coupler/participants/guard.h"
#include "coupler/participants/session.h"

namespace magfsi::replay {

// Throws std::invalid_argument, one line, where the record cannot be played in this run:
// another coupled step, fewer steps, another first step, other fluid probes, more than
// one rank, or an effect that only a real participant has. The scene may differ from the
// recorded one in all else.
coupler::RecordReader open_record(const scene::Scene& scene,
                                  const coupler::ParticipantArguments& arguments,
                                  const coupler::Session& session);

}  // namespace magfsi::replay
