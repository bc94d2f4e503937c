#!/usr/bin/env python3
"""Copies the libraries that a wheel is linked with into it, by auditwheel: its command line with one change.

The platforms of auditwheel let a wheel rely on libraries of a desktop (X11, OpenGL, GLib), which OpenImageIO's libraries
are linked with and which a server or a container does not have. Here it relies on those of the compiler alone.
"""
import dataclasses
import sys

from auditwheel.main import main
from auditwheel.policy import WheelPolicies

OF_THE_COMPILER = {"libc.so.6", "libm.so.6", "libmvec.so.1", "libdl.so.2", "librt.so.1", "libpthread.so.0", "libutil.so.1",
                   "libanl.so.1", "libresolv.so.2", "libgcc_s.so.1", "libstdc++.so.6"}

read_policies = WheelPolicies.__init__


def read_narrower_policies(self, **arguments):
    read_policies(self, **arguments)
    self._policies = [dataclasses.replace(p, whitelist=p.whitelist & OF_THE_COMPILER) for p in self._policies]


WheelPolicies.__init__ = read_narrower_policies
sys.exit(main())
