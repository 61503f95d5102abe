"""Answers for people and programs: records (JSON, CSV), tables and figures."""
