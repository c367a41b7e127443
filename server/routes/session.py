"""Signing in on the page: the token once, a cookie from then on."""

import asyncio

from fastapi import APIRouter, Request
from fastapi.responses import JSONResponse
from pydantic import BaseModel, ConfigDict, Field

from vocalis.server.http.openapi import problems
from vocalis.server.http.problems import NotAuthorised
from vocalis.server.services import Shared

router = APIRouter(tags=["session"])
WRONG_TOKEN_S = 0.5  # to wait before the next guess is heard


class SessionBody(BaseModel):
    model_config = ConfigDict(extra="forbid")
    token: str = Field(max_length=1000, description="what the server printed, or was given as VOCALIS_TOKEN")


class Session(BaseModel):
    signed_in: bool


@router.post("/session", responses={200: {"model": Session}} | problems(415, 422))
async def open_session(body: SessionBody, request: Request, shared: Shared) -> JSONResponse:
    """Give the cookie for the token; a server without a token gives it to anybody and never asks for it."""
    access = shared.access
    if access.token is not None and not access.is_token(body.token):
        await asyncio.sleep(WRONG_TOKEN_S)
        raise NotAuthorised("That is not the token of this server.")
    response = JSONResponse({"signed_in": True})
    access.open_session(response)
    access.introduce(request, response)
    return response
