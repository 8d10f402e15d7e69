// DDS on this machine alone, without multicast.
#pragma once

#include <cstdlib>

namespace omma::test {

/// For this process and those it starts.
inline void use_loopback_dds() {
  setenv("CYCLONEDDS_URI",
         "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name=\"lo\"/></Interfaces>"
         "<AllowMulticast>false</AllowMulticast></General><Discovery><ParticipantIndex>auto"
         "</ParticipantIndex><Peers><Peer address=\"127.0.0.1\"/></Peers></Discovery></Domain></CycloneDDS>",
         1);
}

}  // namespace omma::test
