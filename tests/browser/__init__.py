"""Tests of pages that integrate in the browser."""
