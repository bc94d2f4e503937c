// What of an image follows from what was asked for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "evaluate/render/render_options.h"
#include "evaluate/report/fingerprint.h"
#include "evaluate/report/render_report.h"

namespace duet {

/// The size and the window that are asked for of a film. Throws UsageError for a window that
/// reaches beyond the image.
FilmLayout asked_layout(FilmDescription& film, const RenderOptions& options);
/// The same, as far as it is known of all films.
void check_window(const RenderOptions& options);

/// The samples that are asked for, of `spp` per pixel; nothing if they are all. Throws UsageError
/// if they have no such slice.
std::optional<SampleInterval> asked_samples(const RenderOptions& options, int spp);

/// Adds all that decides the image besides the files and the parameters of the scene; `channels`
/// are those of the image.
void add_settings(Fingerprint& settings, const RenderRecord& record, const RenderRequest& request,
                  const RenderOptions& options, const FilmLayout& layout,
                  const std::vector<std::string>& channels);

}  // namespace duet
