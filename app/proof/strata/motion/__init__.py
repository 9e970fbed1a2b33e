"""Strata of joint logs."""
