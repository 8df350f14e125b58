"""What stands between the core and a plugin: every call goes through here, and every answer is looked at.

A plugin is a program of somebody else's. Whatever it raises and whatever it answers that it must not becomes
one message which names the plugin, its distribution, and what was asked of it; the job is named by who knows
it (`zlmreport.errors.as_problems`). What a plugin is handed it cannot alter.
"""
