// Duet as a C++ library: scenes to images, and images to figures.
#pragma once

#include <duet/chart.h>
#include <duet/comparison.h>
#include <duet/errors.h>
#include <duet/merge.h>
#include <duet/render.h>
#include <duet/rendered_image.h>
#include <duet/scene_description.h>
#include <duet/scene_file.h>
#include <duet/stability.h>
#include <duet/version.h>
