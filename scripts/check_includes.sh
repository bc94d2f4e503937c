#!/usr/bin/env bash
# Fails if an #include goes against the dependencies of the modules:
#   app -> evaluate; python -> library -> evaluate -> {integrators, parsers}; integrators -> transport -> scene
#       -> {materials, lights, media, cameras} -> textures -> {geometry, image} -> math -> base
#   parsers -> scene/description.h and, of a description, scene/field_parameters.h, scene/filter_fields.h,
#              scene/parameter_text.h, scene/texture_uses.h, scene/texture_value.h and scene/texture_texels.h,
#              geometry/mesh.h, geometry/curves.h, materials/measured_table.h,
#              materials/hair_absorption.h, media/volume_grid.h, math, base and parsers
# A module may include itself and every module further right; modules in braces do not see each other.
# What evaluate finds out it returns: it prints nothing and parses no arguments.
# What only POSIX has is used by src/base/system/*.cpp alone; the headers there are plain C++.
set -euo pipefail
cd "$(dirname "$0")/.."

find src parsers -name '*.h' -o -name '*.cpp' | sort | xargs awk '
  BEGIN {
    n = split("app:10 python:11 library:10 evaluate:9 parsers:8 integrators:8 transport:7 scene:6 materials:5 lights:5 media:5 " \
              "cameras:5 textures:4 geometry:3 image:3 math:2 base:1", entries, " ")
    for (i = 1; i <= n; ++i) { split(entries[i], e, ":"); level[e[1]] = e[2] }
  }
  FNR == 1 {
    split(FILENAME, part, "/")
    module = part[1] == "parsers" ? "parsers" : part[2]
  }
  /^#include "/ {
    split($0, quoted, "\"")
    target = quoted[2]
    split(target, path, "/")
    to = path[1]
    if (to == "mitsuba" || to == "mesh" || to == "volume" ||
        to == "curves" || to == "measured" || to == "weave" || to == "values" || to == "xml" ||
        to == "pbrt" || to == "files") to = "parsers"
    if (to == "duet") to = "library"
    if (!(to in level)) { print FILENAME ":" FNR ": include of unknown module: " target; bad = 1; next }
    ok = to == module || level[to] < level[module]
    if (module == "parsers" && to != "parsers")
      ok = to == "math" || to == "base" || target == "scene/description.h" ||
           target == "scene/field_parameters.h" || target == "scene/filter_fields.h" ||
           target == "scene/texture_uses.h" || target == "scene/texture_value.h" ||
           target == "scene/texture_texels.h" || target == "scene/parameter_text.h" ||
           target == "geometry/mesh.h" || target == "geometry/curves.h" ||
           target == "materials/measured_table.h" ||
           target == "materials/hair_absorption.h" || target == "media/volume_grid.h"
    if (!ok) { print FILENAME ":" FNR ": " module " must not include " target; bad = 1 }
  }
  /^#include "geometry\/embree.h"/ && FILENAME !~ /accel_embree[a-z_]*\.cpp$/ {
    print FILENAME ":" FNR ": only geometry/accel_embree*.cpp may know Embree"; bad = 1
  }
  /^#include <embree/ && FILENAME !~ /geometry\/embree\.h$/ {
    print FILENAME ":" FNR ": only geometry/embree.h may include Embree"; bad = 1
  }
  /^#include <(OpenEXR|Imf|OpenImageIO)/ && FILENAME !~ /^src\/image\// {
    print FILENAME ":" FNR ": only src/image may include image libraries"; bad = 1
  }
  module == "evaluate" && (/^#include (<CLI|<iostream>|"base\/log\.h")/ ||
                         /fmt::print|std::(cout|cerr|printf|fprintf|puts|fputs)/) {
    print FILENAME ":" FNR ": evaluate must not print or parse arguments"; bad = 1
  }
  FILENAME !~ /^src\/base\/system\/[a-z_]*\.cpp$/ {
    # <csignal> is there for signals that only POSIX has; fopen() takes an "e" there only.
    if (/^ *# *include *<(aio|arpa\/|csignal|dirent|dlfcn|elf|execinfo|fcntl|fnmatch|ftw|glob|grp|ifaddrs|langinfo|libgen|link|linux\/|net\/|netdb|netinet\/|poll|pthread|pwd|regex\.h|sched|semaphore\.h|signal|spawn|strings\.h|sys\/|syslog|termios|ucontext|unistd|utime|wordexp)/) {
      print FILENAME ":" FNR ": only src/base/system/*.cpp may include headers of POSIX"; bad = 1
    }
    if (!/^ *\/\// &&
        (/(^|[^A-Za-z_0-9])(_exit|dlopen|dlsym|dup2|fdopen|fileno|fork|fseeko|ftello|getpid|getrusage|gmtime_r|isatty|localtime_r|mkdtemp|mkstemp|pclose|popen|putenv|realpath|setenv|strdup|strsignal|timegm|unsetenv|waitpid)\(/ ||
         /fopen\(.*, "[a-z+]*e[a-z+]*"\)/)) {
      print FILENAME ":" FNR ": only src/base/system/*.cpp may call functions of POSIX"; bad = 1
    }
  }
  END { exit bad }'
