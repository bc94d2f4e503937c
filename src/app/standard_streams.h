// Standard streams that whoever started the program has closed.
#pragma once

namespace duet {

/// Gives the numbers of closed standard streams to /dev/null, so that no other file gets them and
/// messages end up in an image. What is written there fails, as it would without this.
void open_standard_streams();

}  // namespace duet
