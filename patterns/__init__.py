"""Layouts, circuits, stitch plans and outlines of SESAMEs: geometry in millimetres."""
