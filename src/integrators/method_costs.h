// What methods cost, from counts of what they do: no clock has a say in which method is chosen.
#pragma once

namespace duet {

/// What is done for one sample of one pixel, on average.
struct WorkPerSample {
  double eye_rays = 0, light_samples = 0;  ///< rays of the eye sub-path, shadow rays to lights
  double light_rays = 0, camera_rays = 0;  ///< of the light sub-paths: theirs, and to the camera
  double connections = 0, connection_rays = 0;  ///< tried, and those that needed a shadow ray
  double merge_queries = 0, merges = 0;
  double stored_vertices = 0;  ///< light vertices that are kept
  double medium_steps = 0;     ///< RenderCounters::medium_steps
};

/// In units of about a microsecond on the machine of docs/performance.md; only ratios matter.
double path_cost(const WorkPerSample& work);
/// What groups of pixels add to a path, with so many shadow rays more.
double pixel_group_cost(double shadow_rays);
/// `path` traces paths in batches (wide_tracer.h), `volpath` one by one.
double volpath_cost(const WorkPerSample& work);
/// Of the methods that trace sub-paths from both ends: with eye sub-paths one by one (`ppm`, `bpm`,
/// and where there are media), or with all sub-paths in batches (wide_eye.h).
double bidirectional_cost(const WorkPerSample& work);
double batched_cost(const WorkPerSample& work);

}  // namespace duet
