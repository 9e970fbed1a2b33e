"""Strata of joint logs of arms whose links and joints are none as described."""
