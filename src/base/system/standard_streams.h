// The standard streams, the terminals that they may be, and images that go to standard output.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace duet {

enum class StandardStream { input, output, error };

bool is_terminal(StandardStream stream);

/// Columns of the terminal that the stream is; 80 if it is none.
size_t terminal_width(StandardStream stream);

/// Gives the numbers of standard streams that whoever started the program has closed to /dev/null,
/// so that no other file gets them and messages end up in an image. What is written there fails, as
/// it would without this.
void open_standard_streams();

/// What stands for a path, before the extension of the format: "<stdout>.png".
inline const std::string kStandardOutput = "<stdout>";

bool is_standard_output(const std::string& path);

/// Empty, or why no image can be written there: a terminal shows no images.
std::string standard_output_refusal();

/// Throws std::runtime_error with the reason if not all bytes can be written.
void write_standard_output(std::span<const uint8_t> bytes);

}  // namespace duet
